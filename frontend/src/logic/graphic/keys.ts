/** What a key does to a rung at the cursor: the keys of CX-Programmer and Sysmac where they have one. */

import { NOTHING } from "./diagram";
import { type Edit, type Empty, type Made, withDeclared } from "./edit";
import { elementOf, fieldText } from "./field";
import { boxNaming } from "./ladderBox";
import {
  coil,
  contact,
  type Edited,
  elementAt,
  insert,
  insertBelow,
  insertBranch,
  insertCoil,
  insertEnd,
  negated,
  nextEdge,
  remove,
  replace,
} from "./ladderEdit";
import type { Place } from "./ladderLayout";
import { openPin, pinNaming, withPinValue } from "./ladderPins";
import { readRung } from "./ladderRead";
import { writeRung } from "./ladderWrite";
import { type Found, networksIn } from "./networks";
import type { Element, Head, Path } from "./tree";

interface Change extends Edited {
  /** The new element has no name yet: its field opens. */
  fresh: boolean;
}

/** Before the number of a pin: the key that opens its field. */
export const PIN = "Pin:";
const NOWHERE = { at: 0, end: 0 };
const box = (): Element => ({ kind: "box", result: null, callee: NOTHING, args: [], output: null, span: NOWHERE });

type Deed = (path: Path, place: Place) => Edited | null;
const link = (kind: "send" | "receive"): Element => ({ kind, name: "link", span: NOWHERE });
const jump = (label: string | null): Element => ({ kind: "jump", label, span: NOWHERE });
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
  "shift+f": (path, place) => insert(path, place, box()),
  j: (path, place) => insertEnd(path, place, jump("label")),
  "#": (path, place) => insertEnd(path, place, link("send")),
  "shift+#": (path, place) => insert(path, place, link("receive")),
};

const PLAIN: Record<string, Deed> = {
  delete: deleted,
  backspace: deletedLeft,
  b: (path, place) => insertBranch(path, place, 1),
  "shift+j": (path, place) => insertEnd(path, place, jump(null)),
  "!": (path, place) => changedAt(path, place, negated),
  e: (path, place) => changedAt(path, place, nextEdge),
};

function changedAt(path: Path, place: Place, change: (element: Element) => Element | null): Edited | null {
  const element = elementAt(path, place);
  const made = element && change(element);
  return made ? { path: replace(path, place, made), place } : null;
}

/** Branches are deleted element by element: where they join nothing is. */
function deleted(path: Path, place: Place): Edited | null {
  return elementAt(path, place)?.kind === "parallel" ? null : remove(path, place);
}

/** The element to the left of the cursor goes, and the cursor stays; at the first one the cursor's own goes. */
function deletedLeft(path: Path, place: Place): Edited | null {
  const index = place.at(-1) ?? 0;
  if (place.length % 2 === 0 || index === 0) return deleted(path, place);
  const left = [...place.slice(0, -1), index - 1];
  if (elementAt(path, left)?.kind === "parallel") return null;
  return { path: remove(path, left).path, place: left };
}

/** The rung after a key; null where the key does nothing there. */
export function afterKey(key: string, path: Path, place: Place): Change | null {
  const lower = key.toLowerCase();
  const [fresh, plain] = [FRESH[lower], PLAIN[lower]];
  const made = (fresh ?? plain)?.(path, place);
  return made ? { ...made, fresh: fresh !== undefined } : null;
}

/** The pin of the box at the cursor that is not connected yet, and the key of its field. */
export function emptyInRung(found: Found, text: string, place: Place): Empty | null {
  const read = readRung({ ...found, ...networksIn(text)[0], text });
  const element = read.kind === "rung" ? elementAt(read.path, place) : null;
  const open = element?.kind === "box" ? openPin(element) : null;
  return open === null ? null : { place, key: `${PIN}${open}` };
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
  const pin = key.startsWith(PIN) ? Number(key.slice(PIN.length)) : null;
  if (!made && !names && pin === null) return null;
  if (comments) return { refused: "graphic.comments" };
  const done = (after: Path, at: Place): Edit => ({ text: writeRung(head, after, indent), place: at, naming: null });
  const named = (after: Path, at: Place): Edit | null => {
    const element = elementAt(after, at);
    if (!element || element.kind === "parallel") return null;
    const { kind } = element;
    if (element.kind === "box" && pin !== null) {
      const naming = pinNaming(element, pin, (box) => done(replace(after, at, box), at));
      return naming && { ...done(after, at), naming };
    }
    const bool = kind === "contact" || kind === "coil";
    const taken = withDeclared((typed) => {
      // What is no box may be the value of the pin that is open.
      const open = element.kind === "box" ? openPin(element) : null;
      const filled = element.kind === "box" && open !== null ? withPinValue(element, open, typed) : null;
      const read = elementOf(kind, typed) ?? filled;
      return read && done(replace(after, at, read), at);
    });
    if (made && kind === "box") {
      const put = (box: Element) => done(replace(after, at, box), at);
      return { ...done(after, at), naming: boxNaming(put, key.toLowerCase() === "shift+f") };
    }
    const unnamed = made && (kind === "send" || kind === "receive" || kind === "jump");
    const value = unnamed ? "" : fieldText(element).replace(bool ? NOTHING : "", "");
    return { ...done(after, at), naming: { value, offers: bool ? "bool" : "none", taken } };
  };
  return made ? (made.fresh ? named : done)(made.path, made.place) : named(path, place);
}
