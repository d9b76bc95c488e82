/** The members of structures, arrays and blocks of the running program, fetched when one is unfolded. */

import { create } from "zustand";
import { waitsForSpace } from "../../logic/plc/plcstate";
import { rest } from "../../wire/rest";
import type { PlcSymbol } from "../../wire/types";
import { usePlc } from "./plc";
import { onInstanceChange } from "./reset";

interface Members {
  instance: number | null;
  of: ReadonlyMap<string, readonly PlcSymbol[]>;
  /** Why a path could not be unfolded. */
  refused: ReadonlyMap<string, string>;
}

export const useMembers = create<Members>(() => ({ instance: null, of: new Map(), refused: new Map() }));

/** A different instance, or a different program in it: all fetched members are invalid. */
export function resetMembers(instance: number | null): void {
  useMembers.setState({ instance, of: new Map(), refused: new Map() });
}

onInstanceChange(({ instance }) => resetMembers(instance?.id ?? null));

// Also when the past is shown: the fetched members may belong to a different program.
usePlc.subscribe(({ state: now }, { state: before }) => {
  if (now && before && now.program_version !== before.program_version) resetMembers(useMembers.getState().instance);
});

/** Whether the PLC cannot list its variables now: before it runs, and while it has no process or does not answer. */
export function isAway(): boolean {
  const { state } = usePlc.getState();
  if (state === null || waitsForSpace(state)) return true;
  return ["off", "starting", "restarting", "silent", "failed"].includes(state.state);
}

/** Whether the page still shows the PLC and the program of now: what was asked of them meanwhile is about a different program. */
export function sameProgram(): () => boolean {
  const asked = programNow();
  return () => {
    const now = programNow();
    return now.instance === asked.instance && now.version === asked.version;
  };
}

const programNow = () => ({
  instance: useMembers.getState().instance,
  version: usePlc.getState().state?.program_version,
});

/** Fetches the members below a path ('' is the top: programs and globals), once. */
export async function loadMembers(path: string): Promise<readonly PlcSymbol[]> {
  const { instance, of } = useMembers.getState();
  const known = of.get(path);
  if (known) return known;
  if (instance === null || isAway()) return [];
  const isCurrent = sameProgram();
  try {
    const symbols = await rest.symbols(instance, path);
    if (isCurrent()) {
      useMembers.setState((state) => {
        const refused = new Map(state.refused);
        refused.delete(path);
        return { of: new Map(state.of).set(path, symbols), refused };
      });
    }
    return symbols;
  } catch (error) {
    const message = error instanceof Error ? error.message : String(error);
    // Users of this store ask again when it changes, so the same refusal must not change it.
    if (!isCurrent() || useMembers.getState().refused.get(path) === message) return [];
    useMembers.setState((state) => ({ refused: new Map(state.refused).set(path, message) }));
    return [];
  }
}
