/** When each step of a chart was active, from samples of its `X`. */

import { partsIn, readChart } from "./charts";
import type { Found } from "./networks";

/** Scans after which a step was active, the first and the last one. */
export interface Stretch {
  from: number;
  to: number;
  /** Whether its beginning and its end are among the samples; else it may be longer. */
  begins: boolean;
  ends: boolean;
}

/** The stretches of one step. `column` has 1 or 0, NaN where there is no value; a sample is taken every so many scans. */
export function stretchesOf(scans: Float64Array, column: Float64Array, every: number): Stretch[] {
  const found: Stretch[] = [];
  let open: Stretch | null = null;
  let before = Number.NaN;
  for (let row = 0; row < scans.length; row += 1) {
    const [scan, value] = [scans[row] as number, column[row] ?? Number.NaN];
    const gap = row === 0 || Number.isNaN(before) || scan - (scans[row - 1] as number) > every;
    if (open && (gap || value !== 1)) {
      open.ends = !gap && value === 0;
      open = null;
    }
    if (value === 1 && open === null) {
      open = { from: scan, to: scan, begins: !gap, ends: false };
      found.push(open);
    } else if (open) open.to = scan;
    before = value;
  }
  return found;
}

export const stretchAt = (stretches: readonly Stretch[], scan: number): Stretch | undefined =>
  stretches.find(({ from, to }) => scan >= from && scan < to + 1);

/** How many scans a stretch had. */
export const lengthOf = ({ from, to }: Stretch) => to - from + 1;

interface Lengths {
  times: number;
  /** In scans, of those whose beginning and end are known; null where there is none. */
  last: number | null;
  least: number | null;
  most: number | null;
}

export function lengthsOf(stretches: readonly Stretch[]): Lengths {
  const whole = stretches.filter(({ begins, ends }) => begins && ends).map(lengthOf);
  const some = whole.length > 0;
  return {
    times: stretches.length,
    last: whole.at(-1) ?? null,
    least: some ? Math.min(...whole) : null,
    most: some ? Math.max(...whole) : null,
  };
}

/** The lane of a step as the path of an SVG: so wide, for scans from `first` to `last`. What is closer than a pixel is one bar. */
export function lanePath(
  stretches: readonly Stretch[],
  first: number,
  last: number,
  width: number,
  height: number,
): string {
  const scale = width / Math.max(1, last + 1 - first);
  let path = "";
  let [left, right] = [Number.NEGATIVE_INFINITY, Number.NEGATIVE_INFINITY];
  const draw = () => {
    if (right > left) path += `M${round(left)} 0H${round(right)}V${height}H${round(left)}z`;
  };
  for (const { from, to } of stretches) {
    const [a, b] = [Math.max(0, (from - first) * scale), Math.min(width, (to + 1 - first) * scale)];
    if (b <= 0 || a >= width) continue;
    if (a - right < 1) right = Math.max(right, b);
    else {
      draw();
      [left, right] = [a, Math.max(b, a + LEAST)];
    }
  }
  draw();
  return path;
}

/** A bar can be seen from this width on. */
const LEAST = 2;

const round = (value: number) => Math.round(value * 10) / 10;

/** The charts of a file that can be read, with the names of their steps. */
export function chartsOf(text: string): { found: Found; steps: { name: string; at: number }[] }[] {
  return partsIn(text).flatMap((found) => {
    if (found.kind !== "chart") return [];
    const read = readChart(found);
    return read.kind === "chart" ? [{ found, steps: read.steps.map(({ name, span }) => ({ name, at: span.at })) }] : [];
  });
}
