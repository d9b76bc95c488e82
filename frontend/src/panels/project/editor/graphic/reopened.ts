/** The open field of an element while others edit the same file: what was begun there is done again in the text as it is now. */

import type { Around, Edit, Naming } from "../../../../logic/graphic/edit";
import type { Place } from "../../../../logic/graphic/ladderLayout";
import { type DrawnPart, type Spot, stopsOf } from "../../../../logic/graphic/sheet";
import { sameElement } from "./cursor";
import { madeOf } from "./made";

/** What opened a field, and the text that it was opened in. */
interface Opened {
  /** The same as long as the field is. */
  id: string;
  /** The row it was opened in. */
  row: number;
  key: string;
  place: Place;
  /** What fields before this one took: the name of a box, before that of its instance. */
  typed: readonly string[];
  part: DrawnPart;
  /** The texts of all parts, and the number of its own among them. */
  texts: readonly string[];
  at: number;
  /** The parts that were looked at last. */
  seen: readonly DrawnPart[];
}

/** An element whose field is open. Its part is drawn with this text, which is written once the element has a name. */
export interface Named extends Edit {
  rung: number;
  naming: Naming;
  opened: Opened;
  /** Somebody else deleted or changed the element, or its part cannot be read now. */
  lost: boolean;
}

/** The key of a row: that of an open field is the same when others put parts in above it, so that it keeps what is typed. */
export function rowKey(index: number, named: Named | null): number {
  if (index === named?.rung) return named.opened.row;
  return named && index === named.opened.row ? named.rung : index;
}

type Arounds = (part: DrawnPart) => Around;

/** Opens a field in a part, whose text may be newer than what is drawn. */
export function opening(
  edit: Edit & { naming: Naming },
  by: Pick<Opened, "key" | "place" | "typed">,
  { drawn, at, part }: { drawn: readonly DrawnPart[]; at: number; part: DrawnPart },
): Named {
  const { naming, place, text } = edit;
  const texts = drawn.map(({ found }, index) => (index === at ? part.found.text : found.text));
  const id = `${place.join(".")} ${naming.head ?? naming.pin ?? naming.offers} ${text}`;
  return { ...edit, rung: at, lost: false, opened: { ...by, id, row: at, part, texts, at, seen: drawn } };
}

/** The field after edits of others. Where its element is not found the field is lost until it is. */
export function followed(named: Named, drawn: readonly DrawnPart[], around: Arounds): Named {
  const { opened } = named;
  if (drawn === opened.seen) return named;
  const texts = drawn.map(({ found }) => found.text);
  const at = indexAfter(opened.texts, texts, opened.at);
  const part = at === null ? undefined : drawn[at];
  const lost = {
    ...named,
    rung: at ?? Math.max(0, Math.min(opened.at, drawn.length - 1)),
    lost: true,
    opened: { ...opened, seen: drawn },
  };
  if (at === null || !part) return lost;
  const now = { ...opened, part, texts, at, seen: drawn };
  if (part.found.text === opened.part.found.text) return { ...named, rung: at, lost: false, opened: now };
  const again = part.readable ? begunAgain(named, part, around) : null;
  return again ? { ...again, rung: at, lost: false, opened: { ...now, place: again.from } } : lost;
}

/** The same edit in a different text of the part; null where its element is gone, or has a different name. */
function begunAgain(
  { opened, naming }: Named,
  part: DrawnPart,
  around: Arounds,
): (Edit & { naming: Naming; from: Place }) | null {
  const { key, typed } = opened;
  const element = placeAfter(opened.part, part, opened.place);
  const found = naming.head ? { place: element?.place ?? [], same: false } : element;
  if (!found) return null;
  let made = madeOf(part, key, found.place, around);
  for (const each of typed) made = made && "naming" in made ? (made.naming?.taken(each, around(part)) ?? null) : null;
  if (!made || "refused" in made || !made.naming) return null;
  return found.same || made.naming.value === naming.value ? { ...made, naming: made.naming, from: found.place } : null;
}

/** How many parts, or characters, two lists begin and end with in common: the beginning first, or the end. */
function common(before: ArrayLike<string>, now: ArrayLike<string>, endFirst = false): { head: number; tail: number } {
  const least = Math.min(before.length, now.length);
  const most = { head: 0, tail: 0 };
  const heads = () => {
    while (most.head < least - most.tail && before[most.head] === now[most.head]) most.head += 1;
  };
  const tails = () => {
    const same = () => before[before.length - 1 - most.tail] === now[now.length - 1 - most.tail];
    while (most.tail < least - most.head && same()) most.tail += 1;
  };
  for (const each of endFirst ? [tails, heads] : [heads, tails]) each();
  return most;
}

/** Where a part is now; null where it is gone. */
function indexAfter(before: readonly string[], now: readonly string[], at: number): number | null {
  const { head, tail } = common(before, now);
  const moved = now.length - before.length;
  if (at < head) return at;
  if (at >= before.length - tail) return at + moved;
  const same = now.indexOf(before[at] ?? "", head);
  if (same >= 0 && same < now.length - tail) return same;
  return moved === 0 ? at : null;
}

const sideOf = (spot: Spot) => ("side" in spot ? spot.side : null);

/** Where an element is in a different text of its part, and whether it is written as before; null where it is gone. */
function placeAfter(before: DrawnPart, now: DrawnPart, place: Place): { place: Place; same: boolean } | null {
  const stops = stopsOf(before);
  const old = stops.find((each) => sameElement(each.place, place));
  if (before.kind !== now.kind) return null;
  if (!old) return { place: [], same: place.length === 0 };
  const like = (all: readonly Spot[], at: number) =>
    all.filter(
      (each) => each.element.kind === old.element.kind && sideOf(each) === sideOf(old) && startOf(each) === at,
    );
  // Pins are written where their box is.
  const rank = like(stops, startOf(old)).indexOf(old);
  const wanted = textOf(before, old);
  const found = (at: number | undefined) => (at === undefined ? undefined : like(stopsOf(now), at)[rank]);
  const starts = [false, true].map((endFirst) => startAfter(old, before.found.text, now.found.text, endFirst));
  const written = (part: DrawnPart) => [
    ...new Set(stopsOf(part).flatMap((each) => (textOf(part, each) === wanted ? [startOf(each)] : []))),
  ];
  const [were, are] = [written(before), written(now)];
  if (were.length === are.length) starts.push(are[were.indexOf(startOf(old))] ?? -1);
  for (const each of starts.map(found))
    if (each && textOf(now, each) === wanted) return { place: each.place, same: true };
  const changed = found(starts[0]);
  return changed ? { place: changed.place, same: false } : null;
}

const startOf = ({ element }: Spot) => element.span.at;
const textOf = ({ found }: DrawnPart, { element: { span } }: Spot) => found.text.slice(span.at, span.end);

function startAfter({ element: { span } }: Spot, before: string, now: string, endFirst: boolean): number {
  const { tail } = common(before, now, endFirst);
  return span.at >= before.length - tail ? span.at + now.length - before.length : span.at;
}
