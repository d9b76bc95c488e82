/** The marks of a plot's axis: round numbers, or round durations and times. */
import { formatTime } from "../format/durations";
import { formatDate } from "../format/values";
import { type AxisUnit, axisText, ticks } from "./plots";
import type { Range } from "./samples";

export interface Mark {
  at: number;
  text: string;
}

/** The number of characters of a line that fit beside the axis. */
const AXIS_CHARACTERS = 10;

const SECOND = 1e9;
const MINUTE = 60 * SECOND;
const HOUR = 60 * MINUTE;
const DAY = 24 * HOUR;
/** Steps between a second and a day; below and above, steps are 1, 2 or 5 times a power of ten. */
const STEPS = [
  ...[1, 2, 5, 10, 15, 30].map((count) => count * SECOND),
  ...[1, 2, 5, 10, 15, 30].map((count) => count * MINUTE),
  ...[1, 2, 3, 6, 12, 24].map((count) => count * HOUR),
];

/** About `count` marks. Values other than numbers are in nanoseconds. */
export function axisMarks(range: Range, count: number, unit: AxisUnit): Mark[] {
  if (unit === "number") return ticks(range, count).map((at) => ({ at, text: axisText(at) }));
  const step = BigInt(stepOf((range.to - range.from) / Math.max(1, count), unit));
  const marks: Mark[] = [];
  // Counted in whole nanoseconds: since 1970 there are more of them than a double can distinguish.
  for (let ns = BigInt(Math.ceil(range.from / Number(step))) * step; Number(ns) <= range.to; ns += step)
    if (unit !== "clock" || (ns >= 0n && ns < BigInt(DAY))) marks.push({ at: Number(ns), text: textOf(ns, unit) });
  return marks;
}

function stepOf(raw: number, unit: AxisUnit): number {
  const least = Math.max(raw, unit === "date" ? DAY : 1);
  const whole = least > DAY ? DAY : 1;
  const round = () => {
    const power = 10 ** Math.floor(Math.log10(least / whole));
    return whole * power * ([1, 2, 5, 10].find((factor) => whole * factor * power >= least) ?? 10);
  };
  return (least > SECOND / 2 && STEPS.find((step) => step >= least)) || Math.max(1, Math.round(round()));
}

function textOf(ns: bigint, unit: AxisUnit): string {
  switch (unit) {
    case "time":
      return lines(formatTime(ns, "").slice(1));
    case "date":
      return formatDate("DATE", ns).replace(/^.*#/, "");
    case "clock":
      return formatDate("TIME_OF_DAY", ns).replace(/^.*#/, "");
    default:
      return formatDate("DATE_AND_TIME", ns)
        .replace(/^.*#/, "")
        .replace(/-(?=\d+:)/, "\n");
  }
}

/** 1m59s and 999ms500us on separate lines: no part of a duration is cut off. */
function lines(text: string): string {
  let length = 0;
  return text.replace(/-?\d+[a-z]+/g, (part) => {
    const broken = length > 0 && length + part.length > AXIS_CHARACTERS;
    length = (broken ? 0 : length) + part.length;
    return broken ? `\n${part}` : part;
  });
}
