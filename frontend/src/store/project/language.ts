/** The language server of the project: it has the texts as they are edited here, beside those that are saved, and answers the editor. */

import { textChange } from "../../logic/project/textChange";
import { LspClient, LspRefused } from "../../wire/lsp";
import { afterFrame } from "../page/afterFrame";
import { usePrefs } from "../page/prefs";
import { useDocuments } from "./documents";

interface Position {
  line: number;
  column: number;
}

const LANGUAGE = "st";
let project: number | null = null;
let client: LspClient | null = null;
/** What the server knows of each open file. */
const told = new Map<string, { text: string; version: number }>();

const uriOf = (path: string) => `scanbench:/${path.split("/").map(encodeURIComponent).join("/")}`;
export const pathOf = (uri: string) => decodeURIComponent(uri.replace(/^scanbench:\/*/, ""));

/** What the server says about a position of a file; null where it has no answer. */
export function askAt<T>(method: string, path: string, at: Position, more: object = {}, signal?: AbortSignal) {
  return askOf<T>(method, path, { ...placeOf(at), ...more }, signal);
}

/** The same about a whole file. */
export function askOf<T>(method: string, path: string, more: object = {}, signal?: AbortSignal): Promise<T | null> {
  return ask<T>(method, { ...documentOf(path), ...more }, signal);
}

export async function ask<T>(method: string, params: object, signal?: AbortSignal): Promise<T | null> {
  try {
    return await demand<T>(method, params, signal);
  } catch (error) {
    if (error instanceof LspRefused) return null;
    throw error;
  }
}

/** Like `askAt`, where a refusal is to be told: rejects with `LspRefused`. */
export function demandAt<T>(method: string, path: string, at: Position, more: object = {}, signal?: AbortSignal) {
  return demand<T>(method, { ...documentOf(path), ...placeOf(at), ...more }, signal);
}

async function demand<T>(method: string, params: object, signal?: AbortSignal): Promise<T | null> {
  follow();
  return (await client?.request<T>(method, params, signal)) ?? null;
}

const documentOf = (path: string) => ({ textDocument: { uri: uriOf(path) } });
const placeOf = ({ line, column }: Position) => ({ position: { line: line - 1, character: column - 1 } });

/** Tells the server what is different. */
function follow(): void {
  const { project: now, open } = useDocuments.getState();
  if (now !== project) {
    client?.close();
    told.clear();
    project = now;
    client = now === null ? null : new LspClient(`/api/projects/${now}/lsp`, begin);
  }
  for (const { path, text } of Object.values(open)) tell(path, text);
  for (const path of told.keys()) if (!open[path]) forget(path);
}

/** A server that knows no texts yet. */
function begin(): void {
  told.clear();
  follow();
}

function tell(path: string, text: string): void {
  const uri = uriOf(path);
  const known = told.get(path);
  if (!known) {
    client?.notify("textDocument/didOpen", { textDocument: { uri, languageId: LANGUAGE, version: 1, text } });
    told.set(path, { text, version: 1 });
    return;
  }
  const change = textChange(known.text, text);
  if (!change) return;
  const version = known.version + 1;
  client?.notify("textDocument/didChange", { textDocument: { uri, version }, contentChanges: [change] });
  told.set(path, { text, version });
}

function forget(path: string): void {
  told.delete(path);
  client?.notify("textDocument/didClose", { textDocument: { uri: uriOf(path) } });
}

useDocuments.subscribe((now, before) => {
  if (now.project !== before.project) follow();
  // Who asks the server something tells it before.
  else if (now.open !== before.open) afterFrame(follow);
  // Somebody saved, made or deleted a file: the server of the project tells the language server what is saved.
  if (now.files !== before.files && now.project === before.project) client?.notify(CHANGED, { changes: [] });
});

// A server that begins now speaks the language of the page.
usePrefs.subscribe((now, before) => {
  if (now.language === before.language) return;
  client?.close();
  project = null;
  follow();
});

const CHANGED = "workspace/didChangeWatchedFiles";

follow();
