/**
 * Live values at the ends of the visible lines. They are elements above the text, and value frames write their texts directly:
 * as decorations, twenty times a second, they would make Monaco lay out its lines again.
 */

import { type NamedVariable, variablesIn } from "../../../logic/debug/inline";
import { lineIn, ownerOf, pouAt } from "../../../logic/plc/sourceLines";
import { loadNames, pathOf, seenAsNow, useSeenAs } from "../../../store/debug/seenAs";
import { frameNow, frameText, useStack } from "../../../store/debug/stack";
import { usePrefs } from "../../../store/page/prefs";
import { useMembers } from "../../../store/plc/members";
import { usePlc } from "../../../store/plc/plc";
import { bindCell } from "../../../store/plc/values";
import { watch } from "../../../store/plc/watches";
import { useDocuments } from "../../../store/project/documents";
import { shownText } from "../../../store/project/shownProgram";
import { forcedAt, useForces } from "../../../store/watch/forces";
import { t } from "../../../text";
import type { Pou } from "../../../wire/types";
import { haltedLineIn } from "./halt";
import type { editor } from "./monaco";
import { hasValues } from "./names";

const MOST = 6;

/** A value at the end of a line: watched by its path, or part of the halt. */
interface Shown {
  name: string;
  path: string | null;
  text: string;
}

interface Row {
  key: string;
  element: HTMLElement;
  /** Shows which values are forced now. */
  paint: () => void;
  release: () => void;
}

export function showInlineValues(code: editor.IStandaloneCodeEditor, path: string): () => void {
  const layer = document.createElement("div");
  layer.className = "inlinelayer";
  layer.setAttribute("aria-hidden", "true");
  code.addOverlayWidget({ getId: () => `inline:${path}`, getDomNode: () => layer, getPosition: () => null });
  const rows = new Map<number, Row>();
  let unwatch: () => void = () => undefined;
  let scheduled = 0;

  function drop(line: number): void {
    rows.get(line)?.release();
    rows.get(line)?.element.remove();
    rows.delete(line);
  }

  function draw(): void {
    scheduled = 0;
    const wanted = rowsIn(code, path);
    for (const line of [...rows.keys()]) if (!wanted.has(line)) drop(line);
    const paths = new Set<string>();
    for (const [line, row] of wanted) {
      for (const each of row.values) if (each.path !== null) paths.add(each.path);
      const key = JSON.stringify(row);
      if (rows.get(line)?.key !== key) {
        drop(line);
        rows.set(line, { key, ...build(row, layer) });
      }
    }
    const before = unwatch;
    unwatch = watch([...paths]);
    before();
    for (const { paint } of rows.values()) paint();
    place(code, rows, layer);
  }

  const schedule = () => {
    scheduled ||= requestAnimationFrame(draw);
  };
  draw();
  const listeners = [
    code.onDidScrollChange(schedule),
    code.onDidLayoutChange(schedule),
    code.onDidChangeModelContent(schedule),
    code.onDidChangeHiddenAreas(schedule),
    // The find widget makes room above the first line, and inlay texts make a line longer.
    code.onDidChangeViewZones(schedule),
    code.onDidChangeModelDecorations(schedule),
  ];
  const stops = [
    useSeenAs.subscribe(schedule),
    useMembers.subscribe(schedule),
    usePrefs.subscribe(schedule),
    useStack.subscribe(schedule),
    useForces.subscribe(schedule),
    useDocuments.subscribe((now, before) => now.pous !== before.pous && schedule()),
    usePlc.subscribe((now, before) => {
      // A PLC that could not say what the names mean is asked again when it is in a different state.
      const keys = ["halt", "program_version", "state"] as const;
      if (keys.some((key) => now.state?.[key] !== before.state?.[key])) schedule();
    }),
  ];
  return () => {
    cancelAnimationFrame(scheduled);
    for (const listener of listeners) listener.dispose();
    for (const stop of stops) stop();
    for (const line of [...rows.keys()]) drop(line);
    unwatch();
  };
}

interface RowWanted {
  values: Shown[];
  /** The line is after the next statement: its values are those of the previous scan. */
  old: boolean;
  /** At the first line of a block with several instances: the one whose values are shown. */
  instance: string;
  /** The text at the end of the line at which the program is halted. */
  next: "" | "next" | "past" | "calls";
}

const SAID = { next: "debug.next", past: "debug.next", calls: "debug.callshere" } as const;

/** The values to show, by line: the variables that the visible lines name, as paths of the instance that the text is seen as. */
function rowsIn(code: editor.IStandaloneCodeEditor, path: string): Map<number, RowWanted> {
  const wanted = new Map<number, RowWanted>();
  const model = code.getModel();
  if (!model) return wanted;
  const { pous, text, built } = shownText(path);
  const halted = haltedLineIn(path);
  const haltedAt = halted && lineIn(built, text, halted.line);
  const on = usePrefs.getState().inline;
  const here = frameNow()?.scanbench?.pou.toUpperCase();
  for (const { startLineNumber, endLineNumber } of code.getVisibleRanges()) {
    let pou = pouAt(pous, path, startLineNumber, text);
    if (pou && on && hasValues(pou)) void loadNames(ownerOf(pous, pou).name);
    let comment = false;
    let step = isInStep(model, startLineNumber);
    for (let line = startLineNumber; line <= endLineNumber; line += 1) {
      const begins = pous.find((known) => known.file === path && known.line === line);
      if (begins && begins !== pou) {
        pou = begins;
        if (on && hasValues(pou)) void loadNames(ownerOf(pous, pou).name);
      } else if (pou?.kind === "action") pou = pouAt(pous, path, line, text);
      const inFrame = pou !== undefined && pou.name.toUpperCase() === here;
      const written = model.getLineContent(line);
      const found = variablesIn(written, comment, step);
      comment = found.comment;
      step = (step || STEP.test(written)) && !END_STEP.test(written);
      const values = pou && on && hasValues(pou) ? valuesOf(found.variables, ownerOf(pous, pou), inFrame) : [];
      const next = haltedAt === line ? saidOf(halted?.look) : "";
      const old = inFrame && haltedAt !== null && line > haltedAt;
      const instance = on && begins && begins.kind !== "action" && hasValues(begins) ? oneOfSeveral(begins.name) : "";
      if (values.length > 0 || next !== "" || instance !== "") wanted.set(line, { values, old, instance, next });
    }
  }
  return wanted;
}

const STEP = /^\s*(?:INITIAL_)?STEP\s+[\p{L}_]/iu;
const END_STEP = /\bEND_STEP\b/i;

/** Whether a line is inside of a step of a chart, by the lines above it. */
function isInStep(model: editor.ITextModel, line: number): boolean {
  for (let above = line - 1; above > 0; above -= 1) {
    const written = model.getLineContent(above);
    if (END_STEP.test(written)) return false;
    if (STEP.test(written)) return true;
    if (/^\s*END_/i.test(written)) return false;
  }
  return false;
}

const saidOf = (look: "halt" | "past" | "frame" | undefined) =>
  look === "frame" ? "calls" : look === "past" ? "past" : "next";

/** Of a POU with several instances the one whose values are shown. */
function oneOfSeveral(pou: string): string {
  const several = (useSeenAs.getState().instances.get(pou.toUpperCase())?.length ?? 0) > 1;
  return several ? (seenAsNow(pou) ?? "") : "";
}

function valuesOf(named: readonly NamedVariable[], pou: Pou, inFrame: boolean): Shown[] {
  const shown: Shown[] = [];
  for (const { path: name } of named) {
    const path = pathOf(pou, name);
    const text = path === undefined && inFrame ? frameText(name) : "";
    if (path !== undefined || text) shown.push({ name, path: path ?? null, text: text ?? "" });
    if (shown.length === MOST) break;
  }
  return shown;
}

/** The elements of a row; from now on the values write their texts themselves. */
function build({ values, old, instance, next }: RowWanted, layer: HTMLElement): Omit<Row, "key"> {
  const element = document.createElement("div");
  element.className = `inlinerow${old ? " old" : ""}`;
  const paints: (() => void)[] = [];
  const releases = values.map((value) => {
    const cell = document.createElement("span");
    const text = document.createElement("b");
    cell.append(value.name, text);
    element.append(cell);
    if (value.path === null) {
      text.textContent = value.text;
      return () => undefined;
    }
    const { path } = value;
    paints.push(() => cell.classList.toggle("forced", forcedAt(path) !== undefined));
    return bindCell(path, "default", (reading) => {
      text.textContent = reading.text;
      cell.hidden = reading.text === "";
      cell.classList.toggle("new", reading.changed && usePlc.getState().state?.halt != null);
    });
  });
  const say = (text: string, look: string) => {
    const said = document.createElement("span");
    said.className = `why ${look}`;
    said.textContent = text;
    element.append(said);
  };
  if (instance !== "") say(t("debug.valuesof", { instance }), "calls");
  if (next !== "") say(t(SAID[next]), next);
  layer.append(element);
  return {
    element,
    paint: () => paints.forEach((paint) => void paint()),
    release: () => releases.forEach((release) => void release()),
  };
}

function place(code: editor.IStandaloneCodeEditor, rows: ReadonlyMap<number, Row>, layer: HTMLElement): void {
  const model = code.getModel();
  const { contentLeft, contentWidth, height } = code.getLayoutInfo();
  layer.style.left = `${contentLeft}px`;
  layer.style.width = `${contentWidth}px`;
  layer.style.height = `${height}px`;
  for (const [line, { element }] of rows) {
    const at = model && code.getScrolledVisiblePosition({ lineNumber: line, column: model.getLineMaxColumn(line) });
    element.hidden = !at;
    if (!model || !at) continue;
    const end = at.left - contentLeft + insertedWidth(code, model, line);
    element.style.transform = `translate(${end + 24}px, ${at.top}px)`;
  }
}

/** How much wider a line is drawn than its text: subrange checks and marks of readers are inserted into it. */
function insertedWidth(code: editor.IStandaloneCodeEditor, model: editor.ITextModel, line: number): number {
  const inserts = model.getLineDecorations(line).some(({ options }) => options.after || options.before);
  if (!inserts) return 0;
  const top = code.getTopForLineNumber(line);
  const drawn = [...(code.getDomNode()?.querySelectorAll<HTMLElement>(".view-line") ?? [])].find(
    ({ style }) => Number.parseFloat(style.top) === top,
  );
  const text = code.getOffsetForColumn(line, model.getLineMaxColumn(line));
  return Math.max(0, (drawn?.firstElementChild?.getBoundingClientRect().width ?? 0) - text);
}
