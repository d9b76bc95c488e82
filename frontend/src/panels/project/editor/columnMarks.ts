/** Breakpoints at one of several statements of a line: while the text is edited, each moves with its own statement. */

import type { BreakpointInfo } from "../../../wire/types";
import { shownLine } from "./halt";
import type { editor } from "./monaco";

interface ColumnMarks {
  show: (all: readonly BreakpointInfo[]) => void;
  /** Where the statement is in the shown text; undefined for a breakpoint of a whole line. */
  of: (id: number) => { line: number; column: number } | undefined;
  forget: () => void;
}

export function columnMarks(code: editor.IStandaloneCodeEditor, path: string): ColumnMarks {
  const marks = code.createDecorationsCollection();
  let ids: readonly number[] = [];

  const of: ColumnMarks["of"] = (id) => {
    const range = marks.getRange(ids.indexOf(id));
    return range ? { line: range.startLineNumber, column: range.startColumn } : undefined;
  };
  return {
    of,
    forget: () => {
      ids = [];
    },
    show: (all) => {
      const shown = all.filter(({ column, at_column }) => column > 0 && at_column > 0);
      const places = shown.map(
        (each) => of(each.id) ?? { line: shownLine(path, each.at_line), column: each.at_column },
      );
      ids = shown.map(({ id }) => id);
      marks.set(places.map(({ line, column }) => decoration(line, column)));
    },
  };
}

const decoration = (line: number, column: number): editor.IModelDeltaDecoration => ({
  range: { startLineNumber: line, startColumn: column, endLineNumber: line, endColumn: column },
  options: { className: "statement-of-breakpoint" },
});
