/** What the open files declare, and in which parts: kept up to date for who looks at it. */

import { useEffect } from "react";
import type { DocumentSymbol } from "vscode-languageserver-types";
import { create } from "zustand";
import { useDocuments } from "./documents";

type Symbols = readonly DocumentSymbol[];

const useSymbols = create<{ of: Readonly<Record<string, Symbols>> }>(() => ({ of: {} }));

/** While somebody types, it is enough to know it a moment later. */
const QUIET_MS = 250;
/** When there was no answer. */
const AGAIN_MS = 2000;

/** How many look at the outline of each file, and what is going to ask for it. */
const followed = new Map<string, { count: number; timer: ReturnType<typeof setTimeout> | undefined }>();
/** The editor and the outline ask about the same text: the server is asked once. */
const asked = new Map<string, { text: string; answer: Promise<Symbols | null> }>();

/** The symbols of a file as it is edited now, with the statements that have others inside; null where there is no answer. */
export function symbolsOf(path: string): Promise<Symbols | null> {
  const text = useDocuments.getState().open[path]?.text ?? "";
  const known = asked.get(path);
  if (known?.text === text) return known.answer;
  const answer = askFor(path);
  asked.set(path, { text, answer });
  void answer.then((found) => {
    if (found === null && asked.get(path)?.answer === answer) asked.delete(path);
  });
  return answer;
}

async function askFor(path: string): Promise<Symbols | null> {
  // With it a connection is opened, which can wait until there is a text.
  const { askOf } = await import("./language");
  return askOf<DocumentSymbol[]>("textDocument/documentSymbol", path);
}

const none: Symbols = [];

/** What a file declares; nothing until that is known. */
export function useOutline(path: string | null): Symbols {
  useEffect(() => (path === null ? undefined : follow(path)), [path]);
  return useSymbols(({ of }) => (path === null ? undefined : of[path])) ?? none;
}

function follow(path: string): () => void {
  const known = followed.get(path) ?? { count: 0, timer: undefined };
  followed.set(path, known);
  known.count += 1;
  if (known.count === 1) void load(path);
  return () => {
    known.count -= 1;
    if (known.count > 0) return;
    clearTimeout(known.timer);
    followed.delete(path);
  };
}

async function load(path: string): Promise<void> {
  if (useDocuments.getState().open[path] === undefined) return;
  const found = await symbolsOf(path);
  if (found === null) later(path, AGAIN_MS);
  else useSymbols.setState(({ of }) => ({ of: { ...of, [path]: found } }));
}

function later(path: string, delay: number): void {
  const known = followed.get(path);
  if (!known) return;
  clearTimeout(known.timer);
  known.timer = setTimeout(() => void load(path), delay);
}

useDocuments.subscribe((now, before) => {
  if (now.project !== before.project) {
    asked.clear();
    useSymbols.setState({ of: {} });
  }
  if (now.open === before.open) return;
  for (const path of followed.keys()) {
    const [text, known] = [now.open[path]?.text, before.open[path]?.text];
    if (text !== known) later(path, known === undefined ? 0 : QUIET_MS);
  }
});
