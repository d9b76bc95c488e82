/** Marks executed lines: bars beside the line numbers, solid, dashed or hollow. */

import { linesOf, sitesIn } from "../../../logic/debug/coverage";
import { lineIn } from "../../../logic/plc/sourceLines";
import { useCoverage } from "../../../store/debug/coverage";
import { shownText } from "../../../store/project/shownProgram";
import type { editor } from "./monaco";

/** Marks the lines in this editor while coverage is on. Returns a function that stops it. */
export function markCoverage(code: editor.IStandaloneCodeEditor, path: string): () => void {
  const marks = code.createDecorationsCollection();
  const mark = () => {
    const { coverage } = useCoverage.getState();
    const { built, text } = shownText(path);
    const shown = (line: number) => lineIn(built, text, line);
    const lines = coverage?.on ? linesOf(sitesIn(coverage, path)) : [];
    marks.set(lines.map(({ line, look, says }) => bar(shown(line), look, says)));
  };
  mark();
  return useCoverage.subscribe(mark);
}

function bar(line: number, look: string, says: string): editor.IModelDeltaDecoration {
  return {
    range: { startLineNumber: line, startColumn: 1, endLineNumber: line, endColumn: 1 },
    options: { linesDecorationsClassName: `cover ${look}`, linesDecorationsTooltip: says },
  };
}
