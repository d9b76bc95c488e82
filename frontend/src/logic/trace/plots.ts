/** How the signals of a trace are distributed over plots and lanes, and the marks of their axes. */
import type { TraceInfo, TraceSignal, TraceWhen } from "../../wire/types";
import type { Range } from "./samples";

const SERIES = 6;
const DASHES: readonly (readonly number[])[] = [[], [6, 3], [2, 2.5], [8, 3, 2, 3]];

export interface Line {
  /** Index among the trace's signals. */
  index: number;
  signal: TraceSignal;
  /** The shortest name: the end of the path that distinguishes it from the others of the plot. */
  name: string;
  color: number;
  dash: readonly number[];
  /** The value holds until the next sample: drawn as steps. */
  steps: boolean;
}

/** The unit of a plot's axis: plain numbers, durations, days, times of day, or date and time. */
export type AxisUnit = "number" | "time" | "date" | "clock" | "moment";

export interface Plot {
  key: string;
  title: string;
  unit: AxisUnit;
  lines: Line[];
}

export function unitOf({ kind, type }: Pick<TraceSignal, "kind" | "type">): AxisUnit {
  if (kind === "time") return "time";
  if (kind !== "date") return "number";
  if (type === "DATE" || type === "LDATE") return "date";
  return type.endsWith("TIME_OF_DAY") ? "clock" : "moment";
}

export interface Layout {
  plots: Plot[];
  lanes: Line[];
}

/** BOOLs get lanes. Other signals share a plot with those that have the same last name, or with those they were dragged to. */
export function layoutOf(signals: readonly TraceSignal[], moved: ReadonlyMap<string, string>): Layout {
  const plots = new Map<string, Plot>();
  const lanes: Line[] = [];
  let numeric = 0;
  signals.forEach((signal, index) => {
    const line: Line = {
      index,
      signal,
      name: signal.text,
      color: (numeric % SERIES) + 1,
      dash: DASHES[Math.floor(numeric / SERIES) % DASHES.length] ?? [],
      steps: signal.kind !== "real",
    };
    if ((signal.kind || "bool") === "bool") {
      lanes.push({ ...line, color: 0, dash: [] });
      return;
    }
    numeric += 1;
    const title = lastName(signal.text);
    const key = moved.get(signal.text) ?? title.toUpperCase();
    const unit = unitOf(signal);
    // An axis has one unit: a signal with a different unit has its own plot, wherever it was dragged.
    const known = `${unit} ${key}`;
    const plot = plots.get(known) ?? { key, title, unit, lines: [] };
    plots.set(known, plot);
    plot.lines.push(line);
  });
  for (const plot of plots.values()) {
    const [only] = plot.lines;
    if (plot.lines.length === 1 && only) plot.title = only.signal.text;
    shorten(plot.lines);
  }
  shorten(lanes);
  return { plots: [...plots.values()], lanes };
}

/** `Main.belt[1].speed` -> `speed`; of an expression the whole text. */
export function lastName(text: string): string {
  const path = /^[\w.[\],^]+$/.test(text) ? text : null;
  return (
    path
      ?.split(".")
      .at(-1)
      ?.replace(/\[[^\]]*\]$/, "") ?? text
  );
}

/** The shortest names that still differ; a beginning and an end that all of them share are omitted. */
function shorten(lines: Line[]): void {
  if (lines.length === 0) return;
  const paths = lines.map(({ signal }) => (/^[\w.[\],^]+$/.test(signal.text) ? signal.text.split(".") : [signal.text]));
  const depth = Math.min(...paths.map((path) => path.length));
  let front = 0;
  while (front < depth - 1 && paths.every((path) => path[front] === paths[0]?.[front])) front += 1;
  let back = 0;
  while (
    lines.length > 1 &&
    back < depth - front - 1 &&
    paths.every((path) => path.at(-1 - back) === paths[0]?.at(-1 - back))
  )
    back += 1;
  lines.forEach((line, at) => {
    const path = paths[at] ?? [];
    line.name = path.slice(front, path.length - back).join(".") || line.signal.text;
  });
}

/** Round numbers between two: 1, 2 or 5 times a power of ten apart, about `count` of them. */
export function ticks({ from, to }: Range, count: number, whole = false): number[] {
  if (!(to > from)) return [from];
  const raw = (to - from) / Math.max(1, count);
  const power = 10 ** Math.floor(Math.log10(raw));
  let step = power * ([1, 2, 5, 10].find((factor) => factor * power >= raw) ?? 10);
  if (whole) step = Math.max(1, Math.round(step));
  const found: number[] = [];
  for (let at = Math.ceil(from / step - 1e-9); at * step <= to + step * 1e-9; at += 1) found.push(at * step + 0); // no -0
  return found;
}

/** A number at an axis, as short as possible. */
export function axisText(value: number): string {
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-3) return value.toExponential(1).replace("e+", "e");
  return Number(value.toPrecision(6)).toString();
}

/** Around a constant time: a tenth of all nanoseconds since 1970 would be years. */
const CONSTANT: Partial<Record<AxisUnit, number>> = { date: 86_400e9, clock: 60e9, moment: 60e9 };

/** A little room above and below; a constant is in the middle. */
export function padded(range: Range | null, unit: AxisUnit = "number"): Range {
  if (range === null) return { from: 0, to: 1 };
  const { from, to } = range;
  if (from === to) {
    const beside = CONSTANT[unit] ?? Math.max(1, Math.abs(from) * 0.1);
    return { from: from - beside, to: to + beside };
  }
  const room = (to - from) * 0.08;
  return { from: from - room, to: to + room };
}

/** A part of a whole, as wide as wanted if the whole is that wide, and always inside it. */
export function within(part: Range, whole: Range, least = 4): Range {
  const width = Math.max(least, Math.min(part.to - part.from, Math.max(least, whole.to - whole.from)));
  const from = Math.max(whole.from, Math.min(part.from, whole.to - width));
  return { from, to: from + width };
}

export function zoomedAt(part: Range, whole: Range, factor: number, held: number): Range {
  const from = held - (held - part.from) * factor;
  return within({ from, to: from + (part.to - part.from) * factor }, whole);
}

export const WHENS: readonly TraceWhen[] = ["rises", "falls", "changes", "above", "below", "equals", "holds"];
/** Trigger kinds that compare with a value. */
export const COMPARES: ReadonlySet<TraceWhen> = new Set(["above", "below", "equals"]);

/** The scans of the buffer that are before the trigger. */
export function scansBefore({ definition }: Pick<TraceInfo, "definition">): number {
  return Math.floor((definition.scans * (definition.trigger?.before ?? 0)) / 100);
}

/** A span of time as 5 min, 1.5 s, 12 ms. */
export function spanText(ns: number): string {
  const units: [number, string][] = [
    [3.6e12, "h"],
    [6e10, "min"],
    [1e9, "s"],
    [1e6, "ms"],
    [1e3, "µs"],
  ];
  const [unit, name] = units.find(([size]) => Math.abs(ns) >= size) ?? [1, "ns"];
  return `${Number((ns / unit).toPrecision(3))} ${name}`;
}
