/** What the debugger marks in a rung or chart: its breakpoints, and the element at which the program is halted. */

import { isShared, lineOf, shapeOf } from "../../../../logic/debug/breakpoints";
import { elementIn, holds } from "../../../../logic/graphic/places";
import type { DrawnPart } from "../../../../logic/graphic/sheet";
import { addBreakpoint, breakpointsAt, removeBreakpoints } from "../../../../store/debug/debug";
import { shownText } from "../../../../store/project/shownProgram";
import type { BreakpointInfo } from "../../../../wire/types";
import { builtLine, type HaltedPlace, shownLine } from "../halt";

export interface PartMarks {
  /** Null where the program is not halted in this part. */
  halt: HaltedPlace | null;
  /** The place of the element that is next, joined by points; empty while the edited text does not tell. */
  next: string;
  /** Its breakpoints, the first one of each element: places joined by points, and what they are drawn as. */
  points: string;
  any: boolean;
}

const NONE: PartMarks = { halt: null, next: "", points: "", any: false };

export function marksOf(
  part: DrawnPart,
  path: string,
  breakpoints: readonly BreakpointInfo[],
  halt: HaltedPlace | null,
): PartMarks {
  const here = breakpoints.filter(({ kind, file }) => kind === "line" && file === path);
  const inside = here.filter((each) => holds(part, shownLine(path, lineOf(each))));
  const halted = halt !== null && holds(part, shownLine(path, halt.line)) ? halt : null;
  if (inside.length === 0 && halted === null) return NONE;
  const points = inside.map((each) => [placeIn(part, path, lineOf(each), each.at_column), shapeOf(each)]);
  return {
    halt: halted,
    next: halted ? placeIn(part, path, halted.line, halted.column) : "",
    points: points
      .filter(([place]) => place !== "")
      .map((each) => each.join(" "))
      .join(","),
    any: inside.length > 0,
  };
}

/** The element at a place of the built text. A line that was edited since tells no columns. */
function placeIn(part: DrawnPart, path: string, line: number, column: number): string {
  const { built, text } = shownText(path);
  const shown = shownLine(path, line);
  if (built.split("\n")[line - 1] !== text.split("\n")[shown - 1]) return "";
  return elementIn(part, { line: shown, column })?.join(".") ?? "";
}

/** A click beside a part: removes all of its breakpoints, or sets one at its first element. */
export function togglePart(path: string, part: DrawnPart, first: { line: number; column: number }): void {
  const lines = part.found.text.split("\n").map((_, index) => builtLine(path, part.found.line + index));
  const here = [...new Set(lines)].flatMap((line) => breakpointsAt(path, line)).filter(isShared);
  if (here.length > 0) void removeBreakpoints(here.map(({ id }) => id));
  else void addBreakpoint({ file: path, line: builtLine(path, first.line), column: first.column });
}
