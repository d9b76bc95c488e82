/** Marks in the text what the cursor of the drawing beside it is at. */
import { useDocuments } from "../../../store/project/documents";
import type { editor } from "./monaco";

/** Marks it in this editor, and scrolls to it. Returns a function that stops it. */
export function markElement(code: editor.IStandaloneCodeEditor, path: string): () => void {
  const marks = code.createDecorationsCollection();
  let shown = "";
  const mark = () => {
    const { active, cursor } = useDocuments.getState();
    const here = active === path && cursor?.element ? { ...cursor, end: cursor.element } : null;
    const key = here ? `${here.line}:${here.column}-${here.end.line}:${here.end.column}` : "";
    if (key === shown) return;
    shown = key;
    marks.set(here ? decorations(here) : []);
    if (here) code.revealLineInCenterIfOutsideViewport(here.line);
  };
  mark();
  return useDocuments.subscribe((now, before) => {
    if (now.cursor !== before.cursor || now.active !== before.active) mark();
  });
}

interface Place {
  line: number;
  column: number;
}

function decorations({ line, column, end }: Place & { end: Place }): editor.IModelDeltaDecoration[] {
  const range = { startLineNumber: line, startColumn: column, endLineNumber: end.line, endColumn: end.column };
  return [
    { range: { ...range, endLineNumber: line }, options: { isWholeLine: true, className: "elementline" } },
    { range, options: { inlineClassName: "elementhere" } },
  ];
}
