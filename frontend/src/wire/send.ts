/** The way out for panels: one command, one answer. */
import { link } from "./socket";
import type { Command, Done } from "./types";

const waiting = new Map<number, (done: Done) => void>();
let nextRef = 1;

/** A fresh reference for a message that is answered under it. */
export function newRef(): number {
  nextRef += 1;
  return nextRef;
}

export type Answer = Done & { sent: boolean };

/** Sends a command and waits for its `Done`. Without a connection it is answered at once with `sent: false`. */
export function send(command: Command): Promise<Answer> {
  const ref = newRef();
  return new Promise((resolve) => {
    if (!link.post({ ...command, ref })) {
      resolve(unanswered(ref, ""));
      return;
    }
    waiting.set(ref, (done) => resolve({ ...done, sent: true }));
  });
}

/** Called with every `Done` that comes in. */
export function settle(done: Done): void {
  const resolve = waiting.get(done.ref);
  waiting.delete(done.ref);
  resolve?.(done);
}

/** The connection went away: whoever waits is told so; whether the command was applied is not known. */
export function abandon(message: string): void {
  const pending = [...waiting.entries()];
  waiting.clear();
  for (const [ref, resolve] of pending) resolve(unanswered(ref, message));
}

function unanswered(ref: number, message: string): Answer {
  return { type: "done", ref, ok: false, message, scan: null, near: [], sent: false };
}
