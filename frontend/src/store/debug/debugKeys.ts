/** Keys of the debugger that refer to the line of the caret. */
import { lineIn } from "../../logic/plc/sourceLines";
import { useDocuments } from "../project/documents";
import { toggleBreakpoint } from "./debug";

/** The caret's line in the built text; null without an open file. The column is 0 unless an element of a drawing is meant. */
export function caretPlace(): { file: string; line: number; column: number } | null {
  const { active, cursor, open } = useDocuments.getState();
  const document = active === null ? undefined : open[active];
  if (!document || !cursor) return null;
  const line = lineIn(document.text, document.savedText, cursor.line);
  return { file: document.path, line, column: cursor.element ? cursor.column : 0 };
}

/** F9. */
export function toggleBreakpointHere(): void {
  const place = caretPlace();
  if (place) void toggleBreakpoint(place.file, place.line, place.column);
}
