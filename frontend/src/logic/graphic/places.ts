/** Elements of a drawing and their places in the file: the compiler knows an element by the line and column where it begins. */

import { keyOf } from "./chart";
import type { Place } from "./ladderLayout";
import { type DrawnPart, spotsOf } from "./sheet";

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

/** The element whose text holds this place, the innermost one; of the statements of an action its first use. Null where none does. */
export function elementIn(part: DrawnPart, { line, column }: InText): Place | null {
  const { text, indent, line: first } = part.found;
  if (!holds(part, line) || !part.readable) return null;
  const above = text.split("\n").slice(0, line - first);
  const offset =
    above.reduce((sum, each) => sum + each.length + 1, 0) + column - 1 - (line === first ? indent.length : 0);
  const spots = spotsOf(part);
  const found = spots.findLast(({ element: { span } }) => offset >= span.at && offset < span.end);
  if (found || part.kind !== "chart") return found?.place ?? null;
  const body = part.bodies.find(({ span }) => offset >= span.at && offset < span.end);
  const use = part.drawing?.elements.find(
    ({ element }) => element.kind === "action" && body && keyOf(element.action) === keyOf(body.name),
  );
  return use?.place ?? null;
}
