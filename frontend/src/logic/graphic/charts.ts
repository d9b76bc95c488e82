/** Where the charts of a file are, and what they say. A chart begins with its first step or transition, and ends with its POU. */

import type { Chart, ChartAction, ChartStep, ChartTransition } from "./chart";
import { readRung } from "./ladderRead";
import { count, type Found, lineStartOf, networksAfter, networksIn, startsLine } from "./networks";
import { NotRead, Reader, wordsIn } from "./reader";
import type { Span, Unread } from "./tree";

const ANY = /^[ \t]*(?:INITIAL_STEP|STEP|TRANSITION)\b/im;
const STEP = /^\s+[\p{L}_][\p{L}\p{N}_]*\s*:(?!=)/u;
const TRANSITION = /^\s*(?:[\p{L}_][\p{L}\p{N}_]*\s*)?(?:\(\s*PRIORITY\s*:=[^)]*\)\s*)?FROM\b/iu;
/** Words that begin a declaration inside of a POU, with the word that ends it. */
const INNER: Readonly<Record<string, string>> = {
  ACTION: "END_ACTION",
  METHOD: "END_METHOD",
  PROPERTY: "END_PROPERTY",
};
const POUS = ["PROGRAM", "FUNCTION_BLOCK", "FUNCTION", "CLASS", "INTERFACE"];

interface FoundChart {
  found: Found;
  /** Its steps and transitions, as offsets of the file: what they hold is drawn with the chart. */
  parts: readonly Span[];
}

/** The networks and charts of a file, in the order of the text. A chart is before the networks of its actions. */
export function partsIn(text: string): readonly Found[] {
  if (last?.text !== text) last = read(text, last);
  return last.parts;
}

interface Known {
  text: string;
  parts: readonly Found[];
  /** All networks, also those that are drawn with a chart. */
  networks: readonly Found[];
}

/** Several ask about the text that was edited last. */
let last: Known | null = null;

function read(text: string, before: Known | null): Known {
  const charts = chartsIn(text);
  const all = before ? networksAfter(text, before) : networksIn(text);
  const networks = all.filter(
    ({ from }) => !charts.some(({ parts }) => parts.some(({ at, end }) => from >= at && from < end)),
  );
  const parts = [...charts.map(({ found }) => found), ...networks].sort((a, b) => a.from - b.from);
  return { text, parts, networks: all };
}

function chartsIn(text: string): FoundChart[] {
  if (!ANY.test(text)) return [];
  const found: FoundChart[] = [];
  let parts: Span[] = [];
  /** The part that is open, or the declaration between two parts, and the word that ends it. */
  let open: { at: number; ends: string; part: boolean } | null = null;
  const finish = (at: number) => {
    const first = parts[0]?.at ?? open?.at;
    if (first !== undefined && (parts.length > 0 || open?.part))
      found.push({ found: chartFrom(text, first, at, open?.part !== true), parts });
    [parts, open] = [[], null];
  };
  for (const { word, at } of wordsIn(text)) {
    const rest = text.slice(at + word.length, at + word.length + 300);
    const begins = /^(?:INITIAL_)?STEP$/.test(word) ? STEP.test(rest) : word === "TRANSITION" && TRANSITION.test(rest);
    if (POUS.some((pou) => word === `END_${pou}`)) finish(at);
    else if (open !== null && word === open.ends) {
      if (open.part) parts.push({ at: open.at, end: at + word.length });
      open = null;
    } else if (open === null && begins && (parts.length > 0 || startsLine(text, at)))
      open = { at, ends: word === "TRANSITION" ? "END_TRANSITION" : "END_STEP", part: true };
    else if (open === null && parts.length > 0 && INNER[word]) open = { at, ends: INNER[word], part: false };
  }
  finish(text.length);
  return found;
}

function chartFrom(text: string, from: number, to: number, closed: boolean): Found {
  const end = from + text.slice(from, to).trimEnd().length;
  return {
    kind: "chart",
    head: { label: "", title: "", comment: [], off: false },
    from,
    to: end,
    line: 1 + count(text, 0, from),
    indent: text.slice(lineStartOf(text, from), from),
    body: { at: 0, end: end - from },
    text: text.slice(from, end),
    closed,
  };
}

/** The chart, or why its text cannot be read. */
export function readChart({ text, closed }: Found): Chart | Unread {
  const reader = new Reader(text);
  const steps: ChartStep[] = [];
  const transitions: ChartTransition[] = [];
  const bodies: { name: string; span: Span }[] = [];
  try {
    while (!reader.done()) {
      const at = reader.at;
      const word = reader.word().toUpperCase();
      if (word === "STEP" || word === "INITIAL_STEP") steps.push(readStep(reader));
      else if (word === "TRANSITION") transitions.push(readTransition(reader));
      else if (INNER[word]) {
        reader.at += word.length;
        const name = reader.word();
        skipTo(reader, INNER[word]);
        if (word === "ACTION") bodies.push({ name, span: { at, end: reader.at } });
      } else if (!reader.takes(";")) throw new NotRead(at, "element");
    }
    if (!closed) throw new NotRead(text.length, "end");
    return { kind: "chart", steps, transitions, bodies };
  } catch (error) {
    if (error instanceof NotRead) return { kind: "unread", at: error.at, expected: error.expected };
    throw error;
  }
}

/** Goes on after this word; returns the text before it. */
function skipTo(reader: Reader, wanted: string): string {
  const from = reader.at;
  for (const { word, at } of wordsIn(reader.text, from, reader.end)) {
    if (word !== wanted) continue;
    reader.at = at + word.length;
    return reader.text.slice(from, at);
  }
  throw new NotRead(from, "end");
}

function takeName(reader: Reader): string {
  const word = reader.word();
  if (word === "") throw new NotRead(reader.at, "operand");
  reader.at += word.length;
  return word;
}

function readStep(reader: Reader): ChartStep {
  const at = reader.at;
  const initial = takeName(reader).toUpperCase() === "INITIAL_STEP";
  const step = takeName(reader);
  const named = { at: reader.at - step.length, end: reader.at };
  reader.expect(":", "element");
  const actions: ChartAction[] = [];
  while (reader.word().toUpperCase() !== "END_STEP") if (!reader.takes(";")) actions.push(readAction(reader, step));
  takeName(reader);
  return { kind: "step", name: step, initial, actions, named, span: { at, end: reader.at } };
}

function readAction(reader: Reader, step: string): ChartAction {
  reader.skip();
  const at = reader.at;
  if (reader.done() || /^END_/i.test(reader.word())) throw new NotRead(at, "end");
  const action = reader.upTo(["(", ";"], "close");
  if (action === "") throw new NotRead(at, "operand");
  const inside: string[] = [];
  if (reader.takes("(")) {
    do inside.push(reader.upTo([",", ")"], "close"));
    while (reader.takes(","));
    reader.expect(")", "close");
  }
  const end = reader.at;
  reader.expect(";", "close");
  const qualifier = (inside[0] || "N").toUpperCase();
  const timed = ["L", "D", "SD", "DS", "SL"].includes(qualifier);
  const [duration = "", indicator = ""] = timed ? inside.slice(1) : ["", ...inside.slice(1)];
  return { kind: "action", action, qualifier, duration, indicator, step, span: { at, end } };
}

function readTransition(reader: Reader): ChartTransition {
  const at = reader.at;
  takeName(reader);
  const name = reader.word().toUpperCase() === "FROM" || reader.sees("(") ? "" : takeName(reader);
  let priority: number | null = null;
  if (reader.takes("(")) {
    const digits = /^PRIORITY\s*:=\s*(\d+)$/i.exec(reader.upTo([")"], "close"))?.[1];
    if (digits === undefined) throw new NotRead(reader.at, "element");
    priority = Number(digits);
    reader.expect(")", "close");
  }
  if (takeName(reader).toUpperCase() !== "FROM") throw new NotRead(reader.at, "element");
  const [from, fromAt] = spanned(reader, readNames);
  if (takeName(reader).toUpperCase() !== "TO") throw new NotRead(reader.at, "element");
  const [to, toAt] = spanned(reader, readNames);
  const { condition, rung, conditionAt } = readCondition(reader);
  const places = { fromAt, toAt, conditionAt };
  return { kind: "transition", name, priority, from, to, condition, rung, ...places, span: { at, end: reader.at } };
}

/** What is read, and where that is written. */
function spanned<T>(reader: Reader, read: (reader: Reader) => T): [T, Span] {
  reader.skip();
  const { at } = reader;
  return [read(reader), { at, end: reader.at }];
}

function readNames(reader: Reader): string[] {
  if (!reader.takes("(")) return [takeName(reader)];
  const names = [takeName(reader)];
  while (reader.takes(",")) names.push(takeName(reader));
  reader.expect(")", "close");
  return names;
}

function readCondition(reader: Reader): Pick<ChartTransition, "condition" | "rung" | "conditionAt"> {
  if (reader.takes(":=")) {
    const begin = reader.at;
    const written = skipTo(reader, "END_TRANSITION");
    const condition = new Reader(written.trimEnd().replace(/;$/, ""));
    condition.skip();
    const text = oneLine(condition.text.slice(condition.at));
    if (text === "") throw new NotRead(reader.at, "operand");
    const at = begin + condition.at;
    const end = begin + condition.text.trimEnd().length;
    return { condition: text, rung: null, conditionAt: { at, end } };
  }
  reader.expect(":", "element");
  reader.skip();
  const from = reader.at;
  const [found] = networksIn(skipTo(reader, "END_TRANSITION"));
  const read = found ? readRung(found) : null;
  if (!found || read?.kind !== "rung") throw new NotRead(from, "element");
  return {
    condition: oneLine(found.text.slice(found.body.at, found.body.end)),
    rung: read.path,
    conditionAt: { at: from, end: reader.at },
  };
}

const oneLine = (text: string) => text.trim().replace(/\s+/g, " ");
