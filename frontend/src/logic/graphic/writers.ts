/** Coils of one variable in several rungs: the last one counts, which people take for a fault of the machine. */

import type { DrawnPart } from "./sheet";

export interface Twice {
  name: string;
  /** Indexes of the rungs that write it, in their order. */
  rungs: readonly number[];
}

/**
 * For each rung its coils whose variable other coils of the same POU write, too. Coils that only set and reset a variable belong
 * together: one at least must be plain.
 */
export function writtenTwice(rungs: readonly { drawn: DrawnPart; pou: string }[]): readonly (readonly Twice[])[] {
  const byName = new Map<string, { name: string; rungs: number[]; coils: number; plain: boolean }>();
  const keysOf: string[][] = rungs.map(() => []);
  for (const [index, { drawn, pou }] of rungs.entries()) {
    if (drawn.kind !== "rung" || drawn.path === null || drawn.found.head.off) continue;
    for (const { element } of drawn.drawing?.elements ?? []) {
      if (element.kind !== "coil") continue;
      const key = `${pou}.${element.operand}`.toUpperCase();
      const known = byName.get(key) ?? { name: element.operand, rungs: [], coils: 0, plain: false };
      if (!known.rungs.includes(index)) known.rungs.push(index);
      byName.set(key, { ...known, coils: known.coils + 1, plain: known.plain || "/".includes(element.mode) });
      if (!keysOf[index]?.includes(key)) keysOf[index]?.push(key);
    }
  }
  return keysOf.map((keys) =>
    keys.flatMap((key) => {
      const each = byName.get(key);
      return each?.plain && each.coils > 1 ? [{ name: each.name, rungs: each.rungs }] : [];
    }),
  );
}
