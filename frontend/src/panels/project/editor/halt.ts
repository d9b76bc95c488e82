/** Marks the next statement while the program is halted: the whole line, and an arrow in the gutter. */
import { lineIn } from "../../../logic/plc/sourceLines";
import { breakpointsAt, useDebug } from "../../../store/debug/debug";
import { frameNow, useStack } from "../../../store/debug/stack";
import { usePlc } from "../../../store/plc/plc";
import { shownText } from "../../../store/project/shownProgram";
import { t } from "../../../text";
import type { editor } from "./monaco";

export interface HaltedPlace {
  line: number;
  column: number;
  /** Identifies the halt and frame, so that the editor scrolls to each once. */
  key: string;
  look: "halt" | "past" | "frame";
  text: string;
}

/** Marks the line in this editor, and scrolls to a new one. Returns a function that stops it. */
export function markHalt(code: editor.IStandaloneCodeEditor, path: string): () => void {
  const marks = code.createDecorationsCollection();
  let shown = "";
  const mark = () => {
    const here = haltedLineIn(path);
    marks.set(here ? [decoration(here, breakpointsAt(path, here.line).length > 0, shownLine(path, here.line))] : []);
    const key = here?.key ?? "";
    if (here && key !== shown) code.revealLineInCenterIfOutsideViewport(shownLine(path, here.line));
    shown = key;
  };
  mark();
  const stops = [usePlc.subscribe(mark), useStack.subscribe(mark), useDebug.subscribe(mark)];
  return () => {
    for (const stop of stops) stop();
  };
}

/** The program runs the built text; the shown text may have been edited since. */
export function shownLine(path: string, line: number): number {
  const { built, text } = shownText(path);
  return lineIn(built, text, line);
}

/** The line of the built text that a line of the shown text comes from. */
export function builtLine(path: string, line: number): number {
  const { built, text } = shownText(path);
  return lineIn(text, built, line);
}

/** Where the program is halted, as a hook. */
export function useHaltedLine(path: string): HaltedPlace | null {
  usePlc((plc) => plc.state?.halt);
  useStack((stack) => stack.frame);
  return haltedLineIn(path);
}

/** The place of the halt, or of a caller that was selected in the call stack. */
export function haltedLineIn(path: string): HaltedPlace | null {
  const halt = usePlc.getState().state?.halt;
  if (!halt) return null;
  const frame = frameNow();
  const { frames } = useStack.getState();
  if (frame && frame.id !== frames[0]?.id) {
    if (frame.source?.path !== path) return null;
    return {
      line: frame.line,
      column: frame.column,
      key: `${halt.number}:${frame.id}`,
      look: "frame",
      text: t("debug.callshere"),
    };
  }
  if (halt.file !== path) return null;
  return {
    line: halt.line,
    column: halt.column,
    key: `${halt.number}`,
    look: halt.past ? "past" : "halt",
    text: halt.text,
  };
}

function decoration({ look, text }: HaltedPlace, breakpoint: boolean, line: number): editor.IModelDeltaDecoration {
  return {
    range: { startLineNumber: line, startColumn: 1, endLineNumber: line, endColumn: 1 },
    options: {
      isWholeLine: true,
      className: `${look}line`,
      marginClassName: `${look}line`,
      glyphMarginClassName: `gl gl-here ${look}${breakpoint && look === "halt" ? " gl-on-bp" : ""}`,
      glyphMarginHoverMessage: { value: text },
      zIndex: 10,
    },
  };
}
