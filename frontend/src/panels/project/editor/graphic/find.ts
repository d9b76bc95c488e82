/** Where in a drawing something is: what is in sight, what a click means, and what is empty. */

import type { Virtualizer } from "@tanstack/react-virtual";
import type { MouseEvent } from "react";
import { emptyIn } from "../../../../logic/graphic/chartKeys";
import { NOTHING } from "../../../../logic/graphic/diagram";
import { diagramOf } from "../../../../logic/graphic/diagramEdit";
import type { Empty } from "../../../../logic/graphic/edit";
import { emptyInRung } from "../../../../logic/graphic/keys";
import type { Place } from "../../../../logic/graphic/ladderLayout";
import { pinAtPoint } from "../../../../logic/graphic/ladderPins";
import type { Found } from "../../../../logic/graphic/networks";
import { holds, inText, stopIn } from "../../../../logic/graphic/places";
import { type DrawnPart, placeOnWire, stepIn, stopsOf } from "../../../../logic/graphic/sheet";
import { type Cursor, sameElement } from "./cursor";

/** Whether all of a part is in sight, by what is known without looking at the page. */
export function isInSight(virtual: Virtualizer<HTMLDivElement, Element>, index: number): boolean {
  const item = virtual.getVirtualItems().find((each) => each.index === index);
  const [top, height] = [virtual.scrollOffset, virtual.scrollRect?.height];
  if (!item || top === null || height === undefined) return false;
  return item.start >= top && item.end <= top + height;
}

/** The element, wire or part that the mouse is at; null where there is none. */
export function cursorAt(drawn: readonly DrawnPart[], event: MouseEvent): Cursor | null {
  const on = event.target instanceof Element ? event.target : null;
  const row = on?.closest<HTMLElement>("[data-index]");
  if (!on || !row) return null;
  const index = Number(row.dataset.index);
  const part = drawn[index];
  const hit = on.closest<SVGElement>("[data-element]")?.dataset.element;
  const goal = on.closest<SVGElement>("[data-goal]")?.dataset.goal;
  const step = goal === undefined ? undefined : stepIn(part, goal);
  const onWire = hit === undefined && part ? wireAt(part, event) : null;
  return { rung: index, place: step ?? onWire ?? (hit === undefined ? [] : hit.split(".").map(Number)) };
}

/** The place on a wire that is clicked; null for a click that means none. */
function wireAt(part: DrawnPart, event: MouseEvent): Place | null {
  const point = pointIn(part, event);
  return point && placeOnWire(part, point.x, point.y);
}

/** The pin of a box in a rung that is clicked; null for a click that means none. */
export function pinAt(part: DrawnPart, event: MouseEvent) {
  const point = pointIn(part, event);
  return part.kind === "rung" && part.drawing && point && pinAtPoint(part.drawing, point.x, point.y);
}

/** Where a click is in the drawing of a part. */
function pointIn(part: DrawnPart, { target, clientX, clientY }: MouseEvent): { x: number; y: number } | null {
  const svg = target instanceof Element ? target.closest("svg.draw") : null;
  if (!svg || !part.drawing) return null;
  const { left, top, width } = svg.getBoundingClientRect();
  const scale = width / part.drawing.width;
  return { x: (clientX - left) / scale, y: (clientY - top) / scale };
}

/** Where the element at the cursor begins in the file. */
export function placeInText(part: DrawnPart | undefined, { place }: Cursor): { line: number; column: number } {
  if (!part) return { line: 1, column: 1 };
  return inText(part, stopsOf(part).find((each) => sameElement(each.place, place))?.element.span.at ?? 0);
}

/** The first and the last place of the text of the element at the cursor; of a part as a whole where it begins. */
export function rangeInText(part: DrawnPart | undefined, { place }: Cursor) {
  const span = stopsOf(part).find((each) => sameElement(each.place, place))?.element.span;
  const begin = placeInText(part, { rung: 0, place });
  if (!part || !span) return [begin, begin] as const;
  return [begin, inText(part, span.end)] as const;
}

/** Where the caret of the text is in a drawing: at an element, or in a part; null where it is in none. After its last character an element is still meant. */
export function placeOfCaret(
  drawn: readonly DrawnPart[],
  { line, column }: { line: number; column: number },
): Cursor | null {
  // The rungs of an action come after their chart, which holds their lines, too.
  const rung = drawn.findLastIndex((part) => holds(part, line));
  const part = drawn[rung];
  if (!part) return null;
  const place = stopIn(part, { line, column }) ?? stopIn(part, { line, column: column - 1 });
  return { rung, place: place ?? [] };
}

/** What is not connected or written yet, from a place on. */
export function emptyAfter(found: Found, text: string, place: Place): Empty | null {
  if (found.kind === "rung") return emptyInRung(found, text, place);
  const next = found.kind === "chart" ? emptyIn(found, text) : emptyInput(text, place);
  return next && { place: next, key: "F2" };
}

/** The first input at or after a place of a network that is not connected; null where there is none. */
function emptyInput(text: string, [index = 0, pin = 0]: Place): Place | null {
  const items = diagramOf(text)?.items ?? [];
  const places = items.flatMap(({ inputs }, item) =>
    inputs.flatMap((input, at): Place[] => (input.text === NOTHING ? [[item, at]] : [])),
  );
  return places.find(([item = 0, at = 0]) => item > index || (item === index && at >= pin)) ?? null;
}
