/** What in-outs are bound to, requested while somebody looks: every two seconds, and when one was written. */

import { create } from "zustand";
import { messageOf } from "../../logic/format/messageOf";
import { rest } from "../../wire/rest";
import type { Binding } from "../../wire/types";
import { useBench } from "../plc/bench";
import { isAway } from "../plc/members";
import { usePlc } from "../plc/plc";
import { useForces } from "./forces";

const AGAIN = 2000;

interface Bindings {
  of: ReadonlyMap<string, Binding>;
}

export const useBindings = create<Bindings>(() => ({ of: new Map() }));

const looking = new Map<string, number>();
/** Requested one after the other: a browser has few connections, and other requests need them more. */
const waiting = new Set<string>();
let asking = false;
let timer: ReturnType<typeof setInterval> | undefined;

/** Watches a binding until the returned function is called. */
export function lookAtBinding(path: string): () => void {
  looking.set(path, (looking.get(path) ?? 0) + 1);
  want([path]);
  timer ??= setInterval(() => {
    if (document.visibilityState === "visible") want(looking.keys());
  }, AGAIN);
  return () => {
    const count = (looking.get(path) ?? 1) - 1;
    if (count > 0) looking.set(path, count);
    else looking.delete(path);
    if (looking.size > 0) return;
    clearInterval(timer);
    timer = undefined;
  };
}

function want(paths: Iterable<string>): void {
  for (const path of paths) waiting.add(path);
  if (!asking) void askAll();
}

async function askAll(): Promise<void> {
  asking = true;
  for (const path of waiting) {
    waiting.delete(path);
    if (looking.has(path)) await ask(path);
  }
  asking = false;
}

async function ask(path: string): Promise<void> {
  const instance = useBench.getState().instance?.id;
  // A PLC without a process cannot answer: the binding is requested again when it is back.
  if (instance === undefined || isAway()) return;
  let found: Binding;
  try {
    found = await rest.binding(instance, path);
  } catch (error) {
    found = { ok: false, message: messageOf(error), convention: "reference", sites: [] };
  }
  if (useBench.getState().instance?.id !== instance) return;
  const { of } = useBindings.getState();
  if (JSON.stringify(of.get(path)) === JSON.stringify(found)) return;
  useBindings.setState({ of: new Map(of).set(path, found) });
}

useBench.subscribe((now, before) => {
  if (now.instance?.id !== before.instance?.id) useBindings.setState({ of: new Map() });
});

// In the past each scan has its own bindings.
usePlc.subscribe(({ state: now }, { state: before }) => {
  if (now?.program_version !== before?.program_version) useBindings.setState({ of: new Map() });
  const moved = now?.past ? now.scan !== before?.scan : before?.past;
  if (moved) want(looking.keys());
});

useForces.subscribe((now, before) => {
  if (now.written !== before.written) want(looking.keys());
});
