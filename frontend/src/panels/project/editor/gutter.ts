/** Breakpoints in the gutter: shown, set and removed there. They move with the text while it is edited. */

import { isShared, lineOf, sayBreakpoint, shapeOf } from "../../../logic/debug/breakpoints";
import { moveBreakpoints, removeBreakpoints, toggleBreakpoint, useDebug } from "../../../store/debug/debug";
import { isDirty, useDocuments } from "../../../store/project/documents";
import { shownText } from "../../../store/project/shownProgram";
import { t } from "../../../text";
import type { BreakpointInfo } from "../../../wire/types";
import { columnMarks } from "./columnMarks";
import { builtLine, shownLine } from "./halt";
import { editor } from "./monaco";

/** The breakpoints of one line of the built text. */
interface Group {
  line: number;
  all: readonly BreakpointInfo[];
}

/** What an editor stores about its breakpoints. */
export interface Gutter {
  /** The shared breakpoints at a line of the shown text. */
  at: (line: number) => readonly BreakpointInfo[];
  /** The line of the built text. */
  built: (line: number) => number;
  dispose: () => void;
}

const GUTTER = [editor.MouseTargetType.GUTTER_GLYPH_MARGIN, editor.MouseTargetType.GUTTER_LINE_NUMBERS];

type Menu = (line: number, at: { x: number; y: number }) => void;

export function showBreakpoints(code: editor.IStandaloneCodeEditor, path: string, openMenu: Menu): Gutter {
  const marks = code.createDecorationsCollection();
  const hint = code.createDecorationsCollection();
  const columns = columnMarks(code, path);
  let groups: readonly Group[] = [];

  const lineNow = (group: Group): number => {
    const index = groups.findIndex(({ line }) => line === group.line);
    return marks.getRange(index)?.startLineNumber ?? shownLine(path, group.line);
  };

  function mark(): void {
    const next = groupsOf(path);
    const lines = next.map(lineNow);
    const { built, text } = shownText(path);
    const edited = text !== built;
    groups = next;
    marks.set(next.map((group, index) => decoration(group, lines[index] ?? group.line, edited)));
    columns.show(next.flatMap(({ all }) => all));
  }

  const at = (line: number) => groups.filter((group) => lineNow(group) === line).flatMap(({ all }) => all);
  const built = (line: number) => groups.find((group) => lineNow(group) === line)?.line ?? builtLine(path, line);

  function toggle(line: number): void {
    const here = at(line).filter(isShared);
    if (here.length > 0) void removeBreakpoints(here.map(({ id }) => id));
    else void toggleBreakpoint(path, built(line));
  }

  mark();
  const stops = [
    useDebug.subscribe((now, before) => {
      if (now.breakpoints !== before.breakpoints) mark();
    }),
    useDocuments.subscribe((now, before) => {
      if (now.build !== before.build && now.build.phase === "done" && now.build.ok) {
        const places = groups.flatMap((group) =>
          group.all.map(({ id }) => [id, columns.of(id) ?? { line: lineNow(group) }] as const),
        );
        if (now.build.author === null) void moveBreakpoints(path, new Map(places));
        // The lines of the server are those of this text from here on; it may have put a breakpoint elsewhere than its mark was.
        groups = [];
        columns.forget();
        mark();
      }
      if (isDirty(now.open[path]) !== isDirty(before.open[path])) mark();
    }),
  ];
  const listeners = [
    // The whole text was replaced (somebody else's text was taken): the positions in the old text are meaningless.
    code.onDidChangeModelContent(({ changes, isFlush }) => {
      if (!isFlush && !(changes.length === 1 && changes[0]?.text === code.getValue())) return;
      groups = [];
      columns.forget();
      mark();
    }),
    code.onMouseDown(({ target, event }) => {
      const line = target.position?.lineNumber;
      if (line === undefined || target.type !== editor.MouseTargetType.GUTTER_GLYPH_MARGIN) return;
      event.preventDefault();
      if (event.leftButton) toggle(line);
    }),
    code.onContextMenu(({ target, event }) => {
      const line = target.position?.lineNumber;
      if (line === undefined || !GUTTER.includes(target.type)) return;
      event.preventDefault();
      event.stopPropagation();
      openMenu(line, { x: event.browserEvent.clientX, y: event.browserEvent.clientY });
    }),
    code.onMouseMove(({ target }) => {
      const over = target.type === editor.MouseTargetType.GUTTER_GLYPH_MARGIN;
      const line = over ? target.position?.lineNumber : undefined;
      hint.set(line === undefined || at(line).length > 0 ? [] : [hintAt(line)]);
    }),
    code.onMouseLeave(() => hint.clear()),
  ];
  return {
    at,
    built,
    dispose: () => {
      for (const stop of stops) stop();
      for (const listener of listeners) listener.dispose();
    },
  };
}

function groupsOf(path: string): Group[] {
  const byLine = new Map<number, BreakpointInfo[]>();
  for (const known of useDebug.getState().breakpoints) {
    if (known.kind !== "line" || known.file !== path) continue;
    byLine.set(lineOf(known), [...(byLine.get(lineOf(known)) ?? []), known]);
  }
  return [...byLine].map(([line, all]) => ({ line, all }));
}

function decoration({ line, all }: Group, shown: number, edited: boolean): editor.IModelDeltaDecoration {
  // A breakpoint that halts takes precedence over one that does not.
  const first = all.find((each) => each.enabled && each.verified) ?? all[0];
  const foreign = all.every((each) => !isShared(each)) ? " foreign" : "";
  const says = all.map(sayBreakpoint);
  if (edited) says.push(t("debug.bp.edited", { line }));
  return {
    range: { startLineNumber: shown, startColumn: 1, endLineNumber: shown, endColumn: 1 },
    options: {
      stickiness: editor.TrackedRangeStickiness.NeverGrowsWhenTypingAtEdges,
      glyphMarginClassName: `gl gl-${first ? shapeOf(first) : "bp"}${foreign}`,
      glyphMarginHoverMessage: says.map((value) => ({ value: value.replace(/\n/g, "  \n") })),
    },
  };
}

const hintAt = (line: number): editor.IModelDeltaDecoration => ({
  range: { startLineNumber: line, startColumn: 1, endLineNumber: line, endColumn: 1 },
  options: { glyphMarginClassName: "gl gl-bp gl-hint", glyphMarginHoverMessage: { value: t("debug.bp.hint") } },
});
