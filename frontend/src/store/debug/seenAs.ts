/** The instance as which the text of a block is seen: its live values are those of this instance. */

import { create } from "zustand";
import { rest } from "../../wire/rest";
import type { PlcSymbol, Pou } from "../../wire/types";
import { isAway, loadMembers, sameProgram, useMembers } from "../plc/members";
import { usePlc } from "../plc/plc";
import { onInstanceChange } from "../plc/reset";
import { useStack } from "./stack";

interface SeenAs {
  /** By the name of a POU, in upper case. */
  chosen: ReadonlyMap<string, string>;
  instances: ReadonlyMap<string, readonly string[]>;
}

export const useSeenAs = create<SeenAs>(() => ({ chosen: new Map(), instances: new Map() }));
const get = useSeenAs.getState;
const set = useSeenAs.setState;

const asked = new Set<string>();

/** A different PLC or program has different instances. A choice stays as long as its instance exists. */
function resetSeenAs(): void {
  asked.clear();
  set({ instances: new Map() });
}

onInstanceChange(resetSeenAs);

/** Fetches the instances of a POU, once for each program. */
export async function loadInstances(pou: string): Promise<void> {
  const key = pou.toUpperCase();
  const { instance } = useMembers.getState();
  if (instance === null || isAway() || asked.has(key)) return;
  asked.add(key);
  const isCurrent = sameProgram();
  try {
    const paths = (await rest.instancesOf(instance, pou)).map(({ path }) => path);
    if (!isCurrent()) return;
    set(({ instances }) => ({ instances: new Map(instances).set(key, paths) }));
  } catch {
    if (isCurrent()) asked.delete(key); // The PLC cannot answer: the instances are requested again when the text is shown the next time.
  }
}

export function choose(pou: string, path: string): void {
  set(({ chosen }) => ({ chosen: new Map(chosen).set(pou.toUpperCase(), path) }));
}

/** The instance whose values are shown in the text of a POU; undefined while there is none. */
export function seenAs({ chosen, instances }: SeenAs, pou: string): string | undefined {
  const key = pou.toUpperCase();
  const all = instances.get(key);
  const wanted = chosen.get(key);
  if (wanted !== undefined && (all === undefined || all.includes(wanted))) return wanted;
  return all?.[0];
}

export const seenAsNow = (pou: string) => seenAs(get(), pou);

// After a halt, and after a frame was selected, the text shows the values of that instance.
usePlc.subscribe(({ state: now }, { state: before }) => {
  const halt = now?.halt;
  if (halt?.instance && halt.number !== before?.halt?.number) choose(halt.pou, halt.instance);
  if (now && before && now.program_version !== before.program_version) resetSeenAs();
});
useStack.subscribe(({ frame, frames }, before) => {
  const here = frames.find(({ id }) => id === frame)?.scanbench;
  if (frame !== before.frame && here?.instance) choose(here.pou, here.instance);
});

/** Fetches what names in the text of a POU can mean: its instances, the variables of the one it is seen as, the globals. */
export async function loadNames(pou: string): Promise<void> {
  await loadInstances(pou);
  const instance = seenAsNow(pou);
  await Promise.all([loadMembers(""), instance === undefined ? [] : loadMembers(instance)]);
}

/**
 * The instance path of a variable as it is written in a POU; undefined when it is not a variable, or not known (yet). Without an
 * instance it is not known: a global variable may have the name of one of the POU's own.
 */
export function pathOf(pou: Pick<Pou, "name" | "kind">, written: string): string | undefined {
  const { of } = useMembers.getState();
  const root = /^[^.[^]+/.exec(written)?.[0].toUpperCase();
  if (root === undefined) return undefined;
  const rest = written.slice(root.length);
  const named = (symbol: PlcSymbol) => symbol.name.toUpperCase() === root;
  const instance = seenAsNow(pou.name);
  if (instance === undefined && pou.kind !== "global") return undefined;
  const own = instance === undefined ? undefined : of.get(instance)?.find(named);
  const found = own ?? of.get("")?.find(named);
  return found && (rest !== "" || !found.expandable) ? found.path + rest : undefined;
}
