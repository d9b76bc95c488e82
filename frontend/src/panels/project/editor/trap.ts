/** Marks the line of a run-time error: the whole line, and an arrow in the gutter. */
import { usePlc } from "../../../store/plc/plc";
import type { InstanceState } from "../../../wire/types";
import type { editor } from "./monaco";

type Trap = NonNullable<InstanceState["trap"]>;

/** Marks the line in this editor until the run-time error is over, and scrolls to a new one. Returns a function that stops it. */
export function markTrap(code: editor.IStandaloneCodeEditor, path: string): () => void {
  const marks = code.createDecorationsCollection();
  let shown: string | null = null;
  const mark = () => {
    const trap = usePlc.getState().state?.trap ?? null;
    const here = trap?.file === path ? trap : null;
    const key = here && `${here.scan}:${here.line}:${here.message}`;
    if (key === shown) return;
    shown = key;
    marks.set(here ? [decoration(here)] : []);
    if (here) code.revealLineInCenterIfOutsideViewport(here.line);
  };
  mark();
  return usePlc.subscribe(mark);
}

function decoration({ line, message }: Trap): editor.IModelDeltaDecoration {
  return {
    range: { startLineNumber: line, startColumn: 1, endLineNumber: line, endColumn: 1 },
    options: {
      isWholeLine: true,
      className: "trapline",
      linesDecorationsClassName: "traparrow",
      linesDecorationsTooltip: message,
    },
  };
}
