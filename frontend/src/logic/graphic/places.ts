/** Elements of a drawing and their places in the file: the compiler knows an element by the line and column where it begins. */

import { keyOf } from "./chart";
import type { Place } from "./ladderLayout";
import { type DrawnPart, spotsOf } from "./sheet";
import type { Span } from "./tree";

interface InText {
  /** From 1, as in an editor. */
  line: number;
  column: number;
}

/** Where an offset from the start of a part is in the file. */
export function inText({ found: { text, line, indent } }: DrawnPart, at: number): InText {
  const before = text.slice(0, at).split("\n");
  const last = before.at(-1)?.length ?? 0;
  return { line: line + before.length - 1, column: last + 1 + (before.length === 1 ? indent.length : 0) };
}

export function holds({ found: { text, line } }: DrawnPart, wanted: number): boolean {
  return wanted >= line && wanted < line + text.split("\n").length;
}

/** Where a place of the file is in the text of a part. */
function offsetIn({ found: { text, indent, line: first } }: DrawnPart, { line, column }: InText): number {
  const above = text.split("\n").slice(0, line - first);
  return above.reduce((sum, each) => sum + each.length + 1, 0) + column - 1 - (line === first ? indent.length : 0);
}

/** The pin of a network whose text holds this place, else the element. Null where neither does. */
export function stopIn(part: DrawnPart, at: InText): Place | null {
  const offset = offsetIn(part, at);
  const holds = ({ span }: { span: Span }) => offset >= span.at && offset < span.end;
  if (part.kind === "network" && part.readable) {
    for (const { element, place } of part.drawing?.elements ?? []) {
      const { inputs, outputs } = element.item;
      const pin = [...inputs, ...outputs].findIndex(holds);
      if (pin >= 0) return [...place, pin];
    }
  }
  return elementIn(part, at);
}

/** The element whose text holds this place, the innermost one; of the statements of an action its first use. Null where none does. */
export function elementIn(part: DrawnPart, { line, column }: InText): Place | null {
  if (!holds(part, line) || !part.readable) return null;
  const offset = offsetIn(part, { line, column });
  const spots = spotsOf(part);
  const found = spots.findLast(({ element: { span } }) => offset >= span.at && offset < span.end);
  if (found || part.kind !== "chart") return found?.place ?? null;
  const body = part.bodies.find(({ span }) => offset >= span.at && offset < span.end);
  const use = part.drawing?.elements.find(
    ({ element }) => element.kind === "action" && body && keyOf(element.action) === keyOf(body.name),
  );
  return use?.place ?? null;
}
