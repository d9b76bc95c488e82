/** Elements of a rung and their places in the file: the compiler knows an element by the line and column where it begins. */

import type { Place } from "./ladderLayout";
import type { DrawnRung } from "./rungs";

interface InText {
  /** From 1, as in an editor. */
  line: number;
  column: number;
}

/** Where an offset from the start of the rung is in the file. */
export function inText({ found: { text, line, indent } }: DrawnRung, at: number): InText {
  const before = text.slice(0, at).split("\n");
  const last = before.at(-1)?.length ?? 0;
  return { line: line + before.length - 1, column: last + 1 + (before.length === 1 ? indent.length : 0) };
}

export function holds({ found: { text, line } }: DrawnRung, wanted: number): boolean {
  return wanted >= line && wanted < line + text.split("\n").length;
}

/** The element whose text holds this place; null where none does. */
export function elementIn(rung: DrawnRung, { line, column }: InText): Place | null {
  const { text, indent, line: first } = rung.found;
  if (!holds(rung, line)) return null;
  const above = text.split("\n").slice(0, line - first);
  const offset =
    above.reduce((sum, each) => sum + each.length + 1, 0) + column - 1 - (line === first ? indent.length : 0);
  const found = rung.drawing?.elements.find(({ element: { span } }) => offset >= span.at && offset < span.end);
  return (rung.path !== null && found?.place) || null;
}
