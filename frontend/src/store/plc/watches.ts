/** The watched paths: counts the watchers of each, keeps the server's list in step, and stores its answers. */
import { create } from "zustand";
import { newRef } from "../../wire/send";
import { link } from "../../wire/socket";
import type { PlcSymbol, Refusal, Watched } from "../../wire/types";
import { assign, drop, forgetIds, forgetValue } from "./values";

interface Watches {
  symbols: ReadonlyMap<string, PlcSymbol>;
  refusals: ReadonlyMap<string, Refusal>;
}

export const useWatches = create<Watches>(() => ({ symbols: new Map(), refusals: new Map() }));

const counts = new Map<string, number>();
const ids = new Map<string, number>();
const toWatch = new Set<string>();
let scheduled = false;

/** Watches paths until the returned function is called. Requests of one turn are sent as one message. */
export function watch(paths: readonly string[]): () => void {
  for (const path of paths) {
    const count = counts.get(path) ?? 0;
    counts.set(path, count + 1);
    if (count === 0) toWatch.add(path);
  }
  schedule();
  let released = false;
  return () => {
    if (released) return;
    released = true;
    for (const path of paths) release(path);
    schedule();
  };
}

function release(path: string): void {
  const count = (counts.get(path) ?? 1) - 1;
  if (count > 0) counts.set(path, count);
  else counts.delete(path);
}

function schedule(): void {
  if (scheduled) return;
  scheduled = true;
  queueMicrotask(exchange);
}

function exchange(): void {
  scheduled = false;
  const gone = [...ids].filter(([path]) => !counts.has(path));
  for (const [path, id] of gone) {
    ids.delete(path);
    drop(path, id);
  }
  if (gone.length > 0) link.post({ type: "unwatch", ids: gone.map(([, id]) => id) });
  const wanted = [...toWatch].filter((path) => counts.has(path) && !ids.has(path));
  if (wanted.length === 0) toWatch.clear();
  else if (link.post({ type: "watch", ref: newRef(), paths: wanted })) toWatch.clear();
}

/** After a connection: sends the whole watch list again. */
export function watchAgain(): void {
  ids.clear();
  forgetIds();
  for (const path of counts.keys()) toWatch.add(path);
  schedule();
}

/** The server's answer; `ref` is null when a new program moved the variables and all ids are new. */
export function onWatching(items: readonly Watched[], moved: boolean): void {
  if (moved) {
    ids.clear();
    forgetIds();
  }
  const symbols = new Map(useWatches.getState().symbols);
  const refusals = new Map(useWatches.getState().refusals);
  for (const { path, id, symbol, refusal } of items) {
    if (symbol) symbols.set(path, symbol);
    else symbols.delete(path);
    if (refusal) refusals.set(path, refusal);
    else refusals.delete(path);
    if (!symbol) forgetValue(path);
    if (id !== null && symbol) {
      ids.set(path, id);
      assign(path, id, symbol);
    }
  }
  useWatches.setState({ symbols, refusals });
  if (moved) askForTheRest(new Set(items.map(({ path }) => path)));
}

/** The server forgets paths that it refused: a different program may have them. */
function askForTheRest(told: ReadonlySet<string>): void {
  for (const path of counts.keys()) if (!told.has(path)) toWatch.add(path);
  schedule();
}
