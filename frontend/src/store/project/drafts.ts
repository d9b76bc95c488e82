/**
 * Files as people edit them together. What is typed goes to the server, which keeps it and tells the others; what it did not acknowledge is
 * sent again after each connection, and kept in this browser until then.
 */

import { type Answer, send } from "../../wire/send";
import type { Draft, DraftEdited } from "../../wire/types";
import { doWaiting } from "../page/afterFrame";
import { usePlc } from "../plc/plc";
import type { Delta, SharedText } from "./sharedText";

interface Shared {
  text: SharedText;
  /** On its way to the server, and what comes after it. */
  sending: Uint8Array | null;
  waiting: Uint8Array | null;
  /** It has all that was here before it came. */
  ready: boolean;
  /** Its tab is closed: it ends when all is acknowledged. */
  leaving: boolean;
}

/** What this browser has of a file without a draft, when the draft comes. */
interface Before {
  text: string;
  /** The saved text from which it was made, and its version; without one it cannot be merged. */
  saved: string;
  version: number | null;
  /** Changes of a draft that the server did not acknowledge when they were made. */
  unsent: readonly { draft: string; update: string }[];
  /** The text with them, from which `text` was made. */
  base: string | null;
}

interface Listener {
  onText(path: string): void;
  /** What the server has not acknowledged changed. */
  onUnsent(path: string): void;
  /** The server does not take what was typed, and would not later; null when it took something again. */
  onRefused(path: string, why: string | null): void;
  /** The file was made again on the server: its draft is a different one, and this one has ended. */
  onEnd(path: string): void;
  /** A change that was not typed in this editor. */
  onDelta(path: string, delta: Delta): void;
}

const RETRY_MS = 2000;
/** Yjs comes with the editor, not with the page. */
let library: typeof import("./sharedText") | null = null;
const shared = new Map<string, Shared>();
const joining = new Map<string, () => Before>();
/** What the server refused to open is asked for again. */
const again = new Map<string, ReturnType<typeof setTimeout>>();
let told: Omit<Listener, "onDelta"> | null = null;
let onDelta: Listener["onDelta"] = () => undefined;

export function followDrafts(listener: Omit<Listener, "onDelta">): void {
  told = listener;
}

export function followDeltas(listener: Listener["onDelta"]): void {
  onDelta = listener;
}

/** The text that is edited together; undefined where there is none, because the server did not answer yet, or the file is gone. */
export function sharedText(path: string): SharedText | undefined {
  const known = shared.get(path);
  return known?.ready ? known.text : undefined;
}

/** What the server has not acknowledged, to be kept here. */
export function unsent(path: string): { draft: string; update: string } | null {
  const known = shared.get(path);
  if (!known || !library) return null;
  const parts = [known.sending, known.waiting].filter((part) => part !== null);
  return parts.length === 0 ? null : { draft: known.text.draft, update: library.encode(library.joined(parts)) };
}

/** Edits a file together with the others from now on; `before` says what is here when the answer has come. */
export async function join(path: string, before: () => Before): Promise<void> {
  const known = shared.get(path);
  if (known) known.leaving = false;
  else await ask(path, before);
}

/** After a connection: what either side missed. */
export function joinAgain(): void {
  for (const path of shared.keys()) void ask(path, () => NOTHING);
}

const NOTHING: Before = { text: "", saved: "", version: null, unsent: [], base: null };

/** What the server has of an open draft, at the latest when this ends; false when it gave no answer. */
export async function refresh(path: string): Promise<boolean> {
  const text = sharedText(path);
  if (!text || !library) return false;
  return (await open(path, text)).ok;
}

function open(path: string, text: SharedText | undefined): Promise<Answer> {
  const vector = text && library ? library.encode(text.vector) : null;
  return send({ type: "open_draft", path, draft: text?.draft ?? null, vector });
}

function askAgain(path: string, before: () => Before): void {
  clearTimeout(again.get(path));
  again.set(
    path,
    setTimeout(() => {
      again.delete(path);
      void ask(path, before);
    }, RETRY_MS),
  );
}

function stopAsking(path: string): void {
  joining.delete(path);
  clearTimeout(again.get(path));
  again.delete(path);
}

async function ask(path: string, before: () => Before): Promise<void> {
  if (joining.has(path)) return;
  joining.set(path, before);
  try {
    library ??= await import("./sharedText");
    if (!(await isConnected()) || joining.get(path) !== before) return;
    const done = await open(path, sharedText(path));
    if (!done.ok && done.sent && joining.get(path) === before) askAgain(path, before);
  } finally {
    if (joining.get(path) === before) joining.delete(path);
  }
}

/** A connection that is being made is waited for. */
async function isConnected(): Promise<boolean> {
  const { state } = usePlc.getState().link;
  if (state !== "connecting") return state === "open";
  return new Promise((settle) => {
    const stop = usePlc.subscribe(({ link }) => {
      if (link.state === "connecting") return;
      stop();
      settle(link.state === "open");
    });
  });
}

/** The file is not edited here any more. */
export function leave(path: string): void {
  const known = shared.get(path);
  if (!known) {
    stopAsking(path);
    return;
  }
  known.leaving = true;
  end(path, known);
}

/** What was typed is nothing that can be sent: the file is gone, or the page shows a different project. */
export function drop(path: string): void {
  // A copy of it that is still to be kept needs it.
  doWaiting();
  shared.get(path)?.text.close();
  shared.delete(path);
  stopAsking(path);
}

export function dropAll(): void {
  for (const path of [...shared.keys(), ...joining.keys(), ...again.keys()]) drop(path);
}

/** The answer of the server to `join`. */
export function onDraft(message: Draft): void {
  const { path } = message;
  const known = shared.get(path);
  const before = joining.get(path)?.() ?? (known && NOTHING);
  if (!before || !library) return;
  if (known && known.text.draft !== message.draft) {
    drop(path);
    told?.onEnd(path);
    return;
  }
  const here = known ?? begin(path, message.draft, library);
  here.text.take(library.decode(message.update));
  if (!known && !bringIn(here, before, message.version)) {
    drop(path);
    return;
  }
  here.ready = true;
  here.sending = null;
  here.waiting = here.text.lackedBy(library.decode(message.vector));
  told?.onText(path);
  told?.onUnsent(path);
  flush(path, here);
  end(path, here);
}

function begin(path: string, draft: string, { SharedText, joined }: typeof import("./sharedText")): Shared {
  const text = new SharedText(draft, {
    onDelta: (delta) => made.ready && onDelta(path, delta),
    onText: () => made.ready && told?.onText(path),
    onOwn: (update) => {
      made.waiting = made.waiting ? joined([made.waiting, update]) : update;
      if (!made.ready) return;
      told?.onUnsent(path);
      flush(path, made);
    },
  });
  const made: Shared = { text, sending: null, waiting: null, ready: false, leaving: false };
  shared.set(path, made);
  return made;
}

/** What was typed before the draft came becomes a change of it. False when it cannot: the text is from a different version. */
function bringIn({ text }: Shared, before: Before, version: number): boolean {
  const unsent = before.unsent.filter(({ draft }) => draft === text.draft);
  for (const { update } of unsent) if (library) text.takeKept(library.decode(update));
  if (unsent.length > 0 && before.base !== null && library) {
    // What was typed since, without the draft, was made of the text with them.
    text.replace(library.merged(before.base, before.text, text.value));
    return true;
  }
  if (before.text === before.saved) return true;
  if (before.version !== version || !library) return false;
  text.replace(library.merged(before.saved, before.text, text.value));
  return true;
}

/** Somebody else typed. */
export function onDraftEdited({ path, draft, update }: DraftEdited): void {
  const known = shared.get(path);
  if (known?.text.draft === draft && library) known.text.take(library.decode(update));
}

function flush(path: string, known: Shared): void {
  if (known.sending || !known.waiting || !library || usePlc.getState().link.state !== "open") return;
  const update = known.waiting;
  known.sending = update;
  known.waiting = null;
  void send({ type: "edit_draft", path, draft: known.text.draft, update: library.encode(update) }).then((done) => {
    if (shared.get(path) !== known || known.sending !== update) return;
    known.sending = null;
    if (!done.ok) known.waiting = library?.joined(known.waiting ? [update, known.waiting] : [update]) ?? null;
    told?.onUnsent(path);
    if (done.ok || done.final) told?.onRefused(path, done.ok ? null : done.message);
    if (done.ok) flush(path, known);
    else if (done.final)
      return; // it goes again with the next change, which may make it one that the server takes
    else if (done.sent) askAgain(path, () => NOTHING); // perhaps the server does not know any more that it is open here
    end(path, known);
  });
}

function end(path: string, known: Shared): void {
  if (!known.leaving || known.sending || known.waiting) return;
  drop(path);
  void send({ type: "close_draft", path });
}
