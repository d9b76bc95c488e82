/** Edits of a rung: each gives a new path and the place for the cursor, and leaves the old path as it is. */

import { isEnd, type Place } from "./ladderLayout";
import type { CoilMode, ContactMode, Element, Parallel, Path } from "./tree";

export interface Edited {
  path: Path;
  place: Place;
}

const NOWHERE = { at: 0, end: 0 };

export const contact = (mode: ContactMode, operand = ""): Element => ({
  kind: "contact",
  mode,
  operand,
  span: NOWHERE,
});
export const coil = (mode: CoilMode, operand = ""): Element => ({ kind: "coil", mode, operand, span: NOWHERE });
const parallel = (branches: readonly Path[]): Parallel => ({ kind: "parallel", branches, span: NOWHERE });

/** The element at a place; null at the start of a path. */
export function elementAt(path: Path, place: Place): Element | null {
  const [index, branch, ...rest] = place;
  if (index === undefined) return null;
  const element = path[index];
  if (element === undefined || branch === undefined) return element ?? null;
  const inner = element.kind === "parallel" ? element.branches[branch] : undefined;
  return inner === undefined ? null : elementAt(inner, rest);
}

/** The path with what `change` makes of the innermost path at a place; `change` is given the index there, -1 at its start. */
function changed(path: Path, place: Place, change: (path: Path, index: number) => Path): Path {
  const [index, branch, ...rest] = place;
  if (index === undefined) return change(path, -1);
  if (branch === undefined) return change(path, index);
  return path.map((element, here) => {
    if (here !== index || element.kind !== "parallel") return element;
    const branches = element.branches.map((each, number) => (number === branch ? changed(each, rest, change) : each));
    return { ...element, branches };
  });
}

const parentOf = (place: Place): Place => place.slice(0, -1);
const lastOf = (place: Place): number => place.at(-1) ?? -1;
const isStart = (place: Place) => place.length % 2 === 0;

/** Puts an element after the cursor. */
export function insert(path: Path, place: Place, element: Element): Edited {
  const next = isStart(place) ? 0 : lastOf(place) + 1;
  return {
    path: changed(path, place, (inner) => [...inner.slice(0, next), element, ...inner.slice(next)]),
    place: isStart(place) ? [...place, 0] : [...parentOf(place), next],
  };
}

/** Puts a coil after the one at the cursor; else at the end of the rung, or of the cursor's branch where branches end at the right rail. */
export function insertCoil(path: Path, place: Place, element: Element): Edited {
  if (elementAt(path, place)?.kind === "coil") return insert(path, place, element);
  const last = path.length - 1;
  const branch = place[0] === last && place.length > 1 && isEnd(path[last]) ? place.slice(0, 2) : [];
  const end = innerPath(path, branch).length - 1;
  return insert(path, end < 0 ? branch : [...branch, end], element);
}

/** Puts in what ends its path: at the end of the rung, or of the cursor's branch. Null where something ends it already. */
export function insertEnd(path: Path, place: Place, element: Element): Edited | null {
  const branch = place.length % 2 === 0 ? place : place.slice(0, -1);
  const inner = innerPath(path, branch);
  const last = inner.at(-1);
  if (last?.kind === "send" || last?.kind === "jump") return null;
  return insert(path, inner.length === 0 ? branch : [...branch, inner.length - 1], element);
}

/** An empty branch below the elements at these places, which are beside each other. */
export function insertBranch(path: Path, place: Place, count: number): Edited | null {
  if (isStart(place)) return null;
  const first = lastOf(place);
  const made = changed(path, place, (inner) => [
    ...inner.slice(0, first),
    parallel([inner.slice(first, first + count), []]),
    ...inner.slice(first + count),
  ]);
  return { path: made, place: [...place, 1] };
}

function innerPath(path: Path, place: Place): Path {
  const [index, branch, ...rest] = place;
  if (index === undefined || branch === undefined) return path;
  const element = path[index];
  return element?.kind === "parallel" ? innerPath(element.branches[branch] ?? [], rest) : [];
}

/** Puts a contact below the element at the cursor, as a branch beside it. */
export function insertBelow(path: Path, place: Place, element: Element): Edited {
  if (isStart(place)) return insert(path, place, element);
  const alone = parentOf(place);
  const around = parentOf(alone);
  const [branch] = alone.slice(-1);
  // An element that is alone in its branch gets one more branch in the same parallel.
  if (branch !== undefined && innerPath(path, alone).length === 1) {
    const grown = changed(path, around, (inner, index) =>
      inner.map((each, here) =>
        here === index && each.kind === "parallel"
          ? parallel([...each.branches.slice(0, branch + 1), [element], ...each.branches.slice(branch + 1)])
          : each,
      ),
    );
    return { path: grown, place: [...around, branch + 1, 0] };
  }
  const here = elementAt(path, place);
  if (here?.kind === "parallel") {
    const branches = [...here.branches, [element]];
    return { path: replace(path, place, parallel(branches)), place: [...place, branches.length - 1, 0] };
  }
  const old = here === null ? [] : [here];
  return { path: replace(path, place, parallel([old, [element]])), place: [...place, 1, 0] };
}

/** The path with a different element at a place. */
export const replace = (path: Path, place: Place, element: Element): Path =>
  changed(path, place, (inner, index) => inner.map((each, here) => (here === index ? element : each)));

/** Deletes the element at the cursor; a branch that is empty then goes too, and a parallel with one branch is no parallel. */
export function remove(path: Path, place: Place): Edited {
  if (isStart(place)) return place.length === 0 ? { path, place } : removeBranch(path, place);
  const without = changed(path, place, (inner, index) => inner.filter((_, here) => here !== index));
  const innermost = parentOf(place);
  if (innermost.length > 0 && innerPath(without, innermost).length === 0) return removeBranch(without, innermost);
  const index = lastOf(place);
  return { path: without, place: index > 0 ? [...innermost, index - 1] : innermost };
}

function removeBranch(path: Path, place: Place): Edited {
  const around = parentOf(place);
  const found = elementAt(path, around);
  if (found?.kind !== "parallel") return { path, place: around };
  const left = found.branches.filter((_, index) => index !== lastOf(place));
  const [only] = left;
  if (left.length > 1 || only === undefined)
    return {
      path: replace(path, around, parallel(left)),
      place: [...around, Math.min(lastOf(place), left.length - 1)],
    };
  const index = lastOf(around);
  const innermost = parentOf(around);
  return {
    path: changed(path, around, (inner, here) => [...inner.slice(0, here), ...only, ...inner.slice(here + 1)]),
    place:
      only.length > 0 ? [...innermost, index + only.length - 1] : index > 0 ? [...innermost, index - 1] : innermost,
  };
}

/** The next mode of an element for `!`: negated or not. */
export function negated(element: Element): Element | null {
  if (element.kind === "contact" || element.kind === "coil")
    return { ...element, mode: element.mode === "/" ? "" : "/" } as Element;
  return null;
}

const EDGES = ["", "P", "N"] as const;

/** The next edge of an element for `E`: none, rising, falling. */
export function nextEdge(element: Element): Element | null {
  if (element.kind !== "contact" && element.kind !== "coil") return null;
  const at = (EDGES as readonly string[]).indexOf(element.mode);
  return { ...element, mode: EDGES[(at + 1) % EDGES.length] ?? "" };
}
