/** Which variables are forced, by whom, and who wrote last. Paths are compared as in the PLC: case does not matter. */

import { create } from "zustand";
import type { ForceInfo } from "../../wire/types";
import { onInstanceChange } from "../plc/reset";

interface WrittenBy {
  author: string;
  scan: number;
}

/** What a force did in the last scan: it changes all the time, so it is stored separately. */
type ForceValues = Pick<ForceInfo, "before" | "after_program" | "after">;

interface Forces {
  held: ReadonlyMap<string, ForceInfo>;
  written: ReadonlyMap<string, WrittenBy>;
}

export const useForces = create<Forces>(() => ({ held: new Map(), written: new Map() }));

export function forceOf(forces: Forces, path: string): ForceInfo | undefined {
  return forces.held.get(path.toUpperCase());
}

/** The active force of this variable or address. */
export const forcedAt = (path: string): ForceInfo | undefined => forceOf(useForces.getState(), path);

export const useForcedAt = (path: string): ForceInfo | undefined => useForces((forces) => forceOf(forces, path));

export const useForceValues = create<{ of: ReadonlyMap<string, ForceValues> }>(() => ({ of: new Map() }));

const identity = ({ path, through, value, author, scan }: ForceInfo) => [path, through, value, author, scan].join("\n");

/** All active forces, as the PLC reports them. */
export function onForces(forces: readonly ForceInfo[]): void {
  useForceValues.setState({ of: new Map(forces.map((force) => [force.path, force])) });
  const before = new Set(useForces.getState().held.values());
  if ([...before].map(identity).join("\r") === forces.map(identity).join("\r")) return;
  const held = new Map<string, ForceInfo>();
  for (const force of forces) {
    // A force on an in-out holds the variable that was passed: both rows are marked.
    for (const path of [force.through, force.path]) if (path) held.set(path.toUpperCase(), force);
  }
  useForces.setState({ held });
}

export function onWritten(path: string, author: string, scan: number): void {
  useForces.setState((state) => ({ written: new Map(state.written).set(path, { author, scan }) }));
}

onInstanceChange(() => useForces.setState({ held: new Map(), written: new Map() }));
