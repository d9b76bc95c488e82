/**
 * Tells Monaco that inlay hints are different. While it asks for them it listens to nobody, and what changes meanwhile would
 * never be drawn: that is told once it has its answers.
 */

type Listener = () => void;

const listeners = new Set<Listener>();
let asking = 0;
let missed = false;

export function onInlaysChanged(listener: Listener): { dispose: () => void } {
  listeners.add(listener);
  return { dispose: () => void listeners.delete(listener) };
}

export function inlaysChanged(): void {
  missed = asking > 0;
  for (const listener of [...listeners]) listener();
}

/** An answer on which Monaco waits. */
export async function asked<T>(answer: Promise<T>): Promise<T> {
  asking += 1;
  try {
    return await answer;
  } finally {
    asking -= 1;
    // In a task of its own: Monaco listens again when it has the answers of all providers.
    if (asking === 0 && missed) setTimeout(inlaysChanged);
  }
}
