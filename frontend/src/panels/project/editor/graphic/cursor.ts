/** The cursor of a drawing: at an element, or at the start of an empty rung. */

import type { KeyboardEvent } from "react";
import { alongWire } from "../../../../logic/graphic/diagramPins";
import type { Place, Way } from "../../../../logic/graphic/ladderLayout";
import { next } from "../../../../logic/graphic/near";
import { type DrawnPart, type Spot, spotsOf, stopsOf } from "../../../../logic/graphic/sheet";

export interface Cursor {
  rung: number;
  place: Place;
}

const WAYS: Record<string, Way> = { ArrowLeft: "left", ArrowRight: "right", ArrowUp: "up", ArrowDown: "down" };

export const sameElement = (a: Place, b: Place) => a.join(".") === b.join(".");

/** The place of the next element in the order of the text; the same one at the end. */
export function elementBeside({ elements }: { elements: readonly Spot[] }, place: Place): Place {
  const at = elements.findIndex((each) => sameElement(each.place, place));
  if (elements[at + 1]?.element.kind === "gap") return place;
  return elements[at + 1]?.place ?? place;
}

/** Where a key moves the cursor to; null where it is no key for that. */
export function moved(
  event: Pick<KeyboardEvent, "key" | "altKey" | "ctrlKey">,
  { rung, place }: Cursor,
  drawn: readonly DrawnPart[],
): Cursor | null {
  const elements = stopsOf(drawn[rung]);
  const step = { ArrowUp: -1, ArrowDown: 1 }[event.key];
  const other = step === undefined ? rung : Math.max(0, Math.min(drawn.length - 1, rung + step));
  const startOf = (at: number): Cursor => ({ rung: at, place: stopsOf(drawn[at])[0]?.place ?? [] });
  if (event.altKey) return null;
  if (event.ctrlKey) return step === undefined ? null : startOf(other);
  if (event.key === "Home") return startOf(rung);
  if (event.key === "End") return { rung, place: spotsOf(drawn[rung]).at(-1)?.place ?? [] };
  const way = WAYS[event.key];
  if (way === undefined) return null;
  const part = drawn[rung];
  const along = part?.kind === "network" && part.drawing ? alongWire(part.drawing, place, way) : null;
  if (along) return { rung, place: along };
  const from = elements.findIndex((each) => sameElement(each.place, place));
  const found = from >= 0 ? next(elements, from, way) : null;
  if (found !== null && elements[found]) return { rung, place: elements[found].place };
  return other === rung ? { rung, place: from < 0 ? startOf(rung).place : place } : startOf(other);
}
