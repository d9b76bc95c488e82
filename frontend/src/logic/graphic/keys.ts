/** What a key does to a rung at the cursor: the keys of CX-Programmer and Sysmac where they have one. */

import {
  coil,
  contact,
  type Edited,
  elementAt,
  insert,
  insertBelow,
  insertCoil,
  negated,
  nextEdge,
  remove,
  replace,
} from "./ladderEdit";
import type { Place } from "./ladderLayout";
import type { Element, Path } from "./tree";

interface Change extends Edited {
  /** The new element has no name yet: its field opens. */
  fresh: boolean;
}

const NOWHERE = { at: 0, end: 0 };
const box = (): Element => ({ kind: "box", result: null, callee: "", args: [], output: null, span: NOWHERE });

type Deed = (path: Path, place: Place) => Edited;
const FRESH: Record<string, Deed> = {
  c: (path, place) => insert(path, place, contact("")),
  "/": (path, place) => insert(path, place, contact("/")),
  w: (path, place) => insertBelow(path, place, contact("")),
  x: (path, place) => insertBelow(path, place, contact("/")),
  o: (path, place) => insertCoil(path, place, coil("")),
  q: (path, place) => insertCoil(path, place, coil("/")),
  s: (path, place) => insertCoil(path, place, coil("S")),
  r: (path, place) => insertCoil(path, place, coil("R")),
  f: (path, place) => insert(path, place, box()),
};

function changedAt(path: Path, place: Place, change: (element: Element) => Element | null): Edited | null {
  const element = elementAt(path, place);
  const made = element && change(element);
  return made ? { path: replace(path, place, made), place } : null;
}

/** The rung after a key; null where the key does nothing there. */
export function afterKey(key: string, path: Path, place: Place): Change | null {
  const lower = key.toLowerCase();
  const deed = FRESH[lower];
  if (deed) return { ...deed(path, place), fresh: true };
  const made =
    key === "!"
      ? changedAt(path, place, negated)
      : lower === "e"
        ? changedAt(path, place, nextEdge)
        : key === "Delete" || key === "Backspace"
          ? remove(path, place)
          : null;
  return made && { ...made, fresh: false };
}
