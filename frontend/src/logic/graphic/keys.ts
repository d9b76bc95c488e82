/** What a key does to a rung at the cursor: the keys of CX-Programmer and Sysmac where they have one. */

import { NOTHING } from "./diagram";
import { type Edit, type Made, withDeclared } from "./edit";
import { elementOf, fieldText } from "./field";
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
import { writeRung } from "./ladderWrite";
import type { Element, Head, Path } from "./tree";

interface Change extends Edited {
  /** The new element has no name yet: its field opens. */
  fresh: boolean;
}

const NOWHERE = { at: 0, end: 0 };
const box = (): Element => ({ kind: "box", result: null, callee: NOTHING, args: [], output: null, span: NOWHERE });

type Deed = (path: Path, place: Place) => Edited;
const FRESH: Record<string, Deed> = {
  c: (path, place) => insert(path, place, contact("", NOTHING)),
  "/": (path, place) => insert(path, place, contact("/", NOTHING)),
  w: (path, place) => insertBelow(path, place, contact("", NOTHING)),
  x: (path, place) => insertBelow(path, place, contact("/", NOTHING)),
  o: (path, place) => insertCoil(path, place, coil("", NOTHING)),
  q: (path, place) => insertCoil(path, place, coil("/", NOTHING)),
  s: (path, place) => insertCoil(path, place, coil("S", NOTHING)),
  r: (path, place) => insertCoil(path, place, coil("R", NOTHING)),
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

/** A rung whose text was read. */
interface Readable {
  head: Head;
  path: Path;
  indent: string;
  /** Comments are between its elements: an edit would lose them. */
  comments: boolean;
}

/** The text of a rung after a key, and what is named then. */
export function rungEdit({ head, path, indent, comments }: Readable, key: string, wanted: Place): Made {
  // The element at the cursor may be gone: somebody else edits the same rung.
  const place = wanted.length % 2 === 0 || elementAt(path, wanted) ? wanted : [];
  const made = afterKey(key, path, place);
  const names = key === "Enter" || key === "F2";
  if (!made && !names) return null;
  if (comments) return { refused: "graphic.comments" };
  const done = (after: Path, at: Place): Edit => ({ text: writeRung(head, after, indent), place: at, naming: null });
  const named = (after: Path, at: Place): Edit | null => {
    const element = elementAt(after, at);
    if (!element || element.kind === "parallel") return null;
    const { kind } = element;
    const bool = kind === "contact" || kind === "coil";
    const taken = withDeclared((typed) => {
      const read = elementOf(kind, typed);
      return read && done(replace(after, at, read), at);
    });
    const value = fieldText(element).replace(kind === "box" ? /^\?\?\?\(\)$/ : NOTHING, "");
    const naming = { value, offers: bool ? ("bool" as const) : ("none" as const), taken };
    return { ...done(after, at), naming: bool ? naming : { ...naming, example: "timer(IN := ~, PT := T#1s).Q" } };
  };
  return made ? (made.fresh ? named : done)(made.path, made.place) : named(path, place);
}
