/** Which variables are forced, by whom, and who wrote last. Paths are compared as in the PLC: case does not matter. */

import { create } from "zustand";
import type { EndedForce, ForceInfo } from "../../wire/types";
import { usePlc } from "../plc/plc";
import { onInstanceChange } from "../plc/reset";

interface WrittenBy {
  author: string;
  scan: number;
}

/** What a force did in the last scan: it changes all the time, so it is stored separately. */
type ForceValues = Pick<ForceInfo, "before" | "after_program" | "after">;

/** A force of yours that somebody else replaced, or ended. What is forced there now is among those held. */
interface Taken {
  path: string;
  by: string;
  mine: string;
}

interface Forces {
  held: ReadonlyMap<string, ForceInfo>;
  written: ReadonlyMap<string, WrittenBy>;
  /** By path, until you have read it. */
  taken: ReadonlyMap<string, Taken>;
}

const NONE: Forces = { held: new Map(), written: new Map(), taken: new Map() };

export const useForces = create<Forces>(() => NONE);

export function forceOf(forces: Pick<Forces, "held">, path: string): ForceInfo | undefined {
  return forces.held.get(path.toUpperCase());
}

/** The active force of this variable or address. */
export const forcedAt = (path: string): ForceInfo | undefined => forceOf(useForces.getState(), path);

export const useForcedAt = (path: string): ForceInfo | undefined => useForces((forces) => forceOf(forces, path));

export const useForceValues = create<{ of: ReadonlyMap<string, ForceValues> }>(() => ({ of: new Map() }));

const identity = ({ path, through, value, author, scan }: ForceInfo) => [path, through, value, author, scan].join("\n");

/** All active forces, as the PLC reports them, and who ended the others. */
export function onForces(forces: readonly ForceInfo[], ended: readonly EndedForce[] = []): void {
  useForceValues.setState({ of: new Map(forces.map((force) => [force.path, force])) });
  const before = new Set(useForces.getState().held.values());
  if ([...before].map(identity).join("\r") === forces.map(identity).join("\r")) return;
  const held = new Map<string, ForceInfo>();
  for (const force of forces) {
    // A force on an in-out holds the variable that was passed: both rows are marked.
    for (const path of [force.through, force.path]) if (path) held.set(path.toUpperCase(), force);
  }
  useForces.setState(({ held: before, taken }) => ({ held, taken: takenNow(before, forces, ended, taken) }));
}

function takenNow(
  before: Forces["held"],
  forces: readonly ForceInfo[],
  ended: readonly EndedForce[],
  known: Forces["taken"],
): Forces["taken"] {
  const you = usePlc.getState().you?.name;
  const taken = new Map(known);
  for (const { path, author } of forces) {
    const was = before.get(path.toUpperCase());
    if (author === you) taken.delete(path);
    else if (was && was.author === you) taken.set(path, { path, by: author, mine: was.value });
  }
  for (const { path, by } of ended) {
    const was = before.get(path.toUpperCase());
    if (was && was.author === you && by !== you) taken.set(was.path, { path: was.path, by, mine: was.value });
  }
  return taken;
}

export function forgetTaken(path: string): void {
  useForces.setState(({ taken }) => ({ taken: new Map([...taken].filter(([key]) => key !== path)) }));
}

/** The force there, if somebody else made it. */
export function heldByOther(path: string): ForceInfo | undefined {
  const force = forcedAt(path);
  return force?.author === usePlc.getState().you?.name ? undefined : force;
}

export function onWritten(path: string, author: string, scan: number): void {
  useForces.setState((state) => ({ written: new Map(state.written).set(path, { author, scan }) }));
}

onInstanceChange(() => useForces.setState(NONE));
