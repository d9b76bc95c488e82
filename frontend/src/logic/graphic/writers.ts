/** Coils of one variable in several rungs: the last one counts, which people take for a fault of the machine. */

import type { DrawnPart } from "./sheet";
import type { Element } from "./tree";

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
    for (const { operand, mode } of coilsOf(drawn)) {
      const key = `${pou}.${operand}`.toUpperCase();
      const known = byName.get(key) ?? { name: operand, rungs: [], coils: 0, plain: false };
      if (known.rungs.at(-1) !== index) known.rungs.push(index);
      known.coils += 1;
      known.plain ||= "/".includes(mode);
      byName.set(key, known);
      if (!keysOf[index]?.includes(key)) keysOf[index]?.push(key);
    }
  }
  return keysOf.map((keys) => {
    const twice = keys.flatMap((key) => {
      const each = byName.get(key);
      return each?.plain && each.coils > 1 ? [{ name: each.name, rungs: each.rungs }] : [];
    });
    return twice.length === 0 ? NONE : twice;
  });
}

const NONE: readonly Twice[] = [];

interface Written {
  operand: string;
  mode: string;
}

/** The coils of each drawing: an edit changes one of many. */
const coils = new WeakMap<object, readonly Written[]>();

function coilsOf({ drawing, kind }: DrawnPart): readonly Written[] {
  if (kind !== "rung" || !drawing) return [];
  const known = coils.get(drawing);
  if (known) return known;
  const found = drawing.elements.flatMap(({ element }) => (element.kind === "coil" ? [element] : []));
  coils.set(drawing, found);
  return found;
}

const isEffect = (element: Element): boolean =>
  element.kind === "parallel"
    ? element.branches.some((branch) => branch.some(isEffect))
    : element.kind !== "contact" && element.kind !== "receive";

/** Whether a rung has contacts and nothing that they could switch: no coil, box, jump or link. */
export function writesNothing(part: DrawnPart): boolean {
  if (part.kind !== "rung" || !part.path || part.path.length === 0) return false;
  return !part.path.some(isEffect);
}
