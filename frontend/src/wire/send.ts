/** Sends the commands of panels: one command, one answer. */
import { link } from "./socket";
import type { Command, Done } from "./types";

const waiting = new Map<number, (done: Done) => void>();
let nextRef = 1;

/** A new reference for a message; the answer has the same reference. */
export function newRef(): number {
  nextRef += 1;
  return nextRef;
}

export type Answer = Done & { sent: boolean };

/** Sends a command and waits for its `Done`. Without a connection it resolves at once with `sent: false`. */
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

/** Called with every `Done` that arrives. */
export function settle(done: Done): void {
  const resolve = waiting.get(done.ref);
  waiting.delete(done.ref);
  resolve?.(done);
}

/** The connection was lost: every waiting command resolves; whether it was applied is not known. */
export function abandon(message: string): void {
  const pending = [...waiting.entries()];
  waiting.clear();
  for (const [ref, resolve] of pending) resolve(unanswered(ref, message));
}

function unanswered(ref: number, message: string): Answer {
  return { type: "done", ref, ok: false, message, scan: null, near: [], final: false, sent: false };
}
