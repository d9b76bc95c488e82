/** What in-outs are bound to, asked for as long as somebody looks: again each two seconds, and when one was written. */
import { create } from "zustand";
import { rest } from "../wire/rest";
import type { Binding } from "../wire/types";
import { useBench } from "./bench";
import { messageOf } from "./documents";
import { useForces } from "./forces";

const AGAIN = 2000;

interface Bindings {
  of: ReadonlyMap<string, Binding>;
}

export const useBindings = create<Bindings>(() => ({ of: new Map() }));

const looking = new Map<string, number>();
let timer: ReturnType<typeof setInterval> | undefined;

/** Looks at a binding until the returned function is called. */
export function lookAtBinding(path: string): () => void {
  looking.set(path, (looking.get(path) ?? 0) + 1);
  void ask(path);
  timer ??= setInterval(() => {
    if (document.visibilityState === "visible") for (const each of looking.keys()) void ask(each);
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

async function ask(path: string): Promise<void> {
  const instance = useBench.getState().instance?.id;
  if (instance === undefined) return;
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

useForces.subscribe((now, before) => {
  if (now.written !== before.written) for (const path of looking.keys()) void ask(path);
});
