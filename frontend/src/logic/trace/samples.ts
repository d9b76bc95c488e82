/** Samples of a trace in the format of the wire (`taps/trace_buffer.py` of the backend, `Samples.pack`), and rows of them. */

import type { TraceSignal } from "../../wire/types";
import type { ValueShape } from "../format/formats";
import { formatValue } from "../format/values";

export interface Range {
  from: number;
  to: number;
}

/** Rows, oldest first: NaN where a signal has no value. Decimated rows come in pairs: least and greatest value of a stretch. */
export interface Samples {
  /** Scans `first` to `end` - 1 are all that exist. */
  first: number;
  end: number;
  generation: number;
  decimated: boolean;
  scans: Float64Array;
  columns: readonly Float64Array[];
  /** The bytes of the same values, for exact texts. */
  raw: readonly BigUint64Array[];
}

const HEAD = 32;

const shapeOf = ({ kind, size, type, values }: TraceSignal): ValueShape => ({
  kind: (kind || "bool") as ValueShape["kind"],
  size: size || 1,
  type,
  values: values.map(([name, value]) => ({ name: String(name), value: Number(value) })),
});

export function decode(buffer: ArrayBuffer, signals: readonly TraceSignal[]): Samples {
  const view = new DataView(buffer);
  const count = view.getUint16(2, true);
  const rows = view.getUint32(4, true);
  const words = (index: number) => new BigUint64Array(buffer, HEAD + index * 8 * rows, rows);
  const scans = Float64Array.from(words(0), Number);
  const valid = words(1);
  const raw = Array.from({ length: count }, (_, index) => words(2 + index));
  return {
    first: Number(view.getBigUint64(8, true)),
    end: Number(view.getBigUint64(16, true)),
    generation: Number(view.getBigUint64(24, true)),
    decimated: view.getUint8(1) !== 0,
    scans,
    columns: raw.map((words, index) => numbers(words, valid, index, signals[index])),
    raw,
  };
}

function numbers(words: BigUint64Array, valid: BigUint64Array, index: number, signal?: TraceSignal): Float64Array {
  const size = signal?.size || 1;
  const kind = signal?.kind ?? "bool";
  const wide = size === 8;
  const found = new Float64Array(words.length);
  const halves = new Uint32Array(words.buffer, words.byteOffset, words.length * 2);
  const has = new Uint32Array(valid.buffer, valid.byteOffset, valid.length * 2);
  const floats = new Float32Array(words.buffer, words.byteOffset, words.length * 2);
  const doubles = new Float64Array(words.buffer, words.byteOffset, words.length);
  const half = index < 32 ? 0 : 1;
  const bit = index % 32;
  const signed = kind === "int" || kind === "time" || kind === "date";
  const shift = 32 - 8 * size;
  for (let row = 0; row < words.length; row += 1) {
    if ((((has[2 * row + half] as number) >>> bit) & 1) === 0) found[row] = Number.NaN;
    else if (kind === "real") found[row] = (wide ? doubles[row] : floats[2 * row]) as number;
    else if (wide) {
      const high = halves[2 * row + 1] as number;
      found[row] = (signed ? high | 0 : high) * 4294967296 + (halves[2 * row] as number);
    } else {
      const low = halves[2 * row] as number;
      found[row] = signed ? (low << shift) >> shift : low;
    }
  }
  return found;
}

/** The rows of `before` followed by newer rows; only the last `most` of them. */
export function appended(before: Samples, more: Samples, most: number): Samples {
  const rows = before.scans.length + more.scans.length;
  const skip = Math.max(0, Math.min(before.scans.length, rows - most));
  if (more.scans.length === 0 && skip === 0) return { ...before, first: more.first, end: more.end };
  const kept = before.scans.length - skip;
  const join = <T extends Float64Array | BigUint64Array>(one: T, other: T, made: T): T => {
    made.set(one.subarray(skip) as never, 0);
    made.set(other as never, kept);
    return made;
  };
  const length = kept + more.scans.length;
  return {
    ...more,
    scans: join(before.scans, more.scans, new Float64Array(length)),
    columns: more.columns.map((column, index) =>
      join(before.columns[index] ?? new Float64Array(before.scans.length), column, new Float64Array(length)),
    ),
    raw: more.raw.map((words, index) =>
      join(before.raw[index] ?? new BigUint64Array(before.scans.length), words, new BigUint64Array(length)),
    ),
  };
}

/** Index of the first row whose scan is `scan` or later. */
export function lowerBound(scans: Float64Array, scan: number): number {
  let low = 0;
  let high = scans.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((scans[middle] as number) < scan) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** The row at a scan, or the last one before it; -1 where there is none. */
export function rowAt(samples: Samples, scan: number): number {
  const at = lowerBound(samples.scans, scan + 1) - 1;
  return at;
}

/** The row nearest to a scan; -1 where there are none. */
export function nearestRow(samples: Samples, scan: number): number {
  const { scans } = samples;
  const after = lowerBound(scans, scan);
  if (after === 0) return scans.length > 0 ? 0 : -1;
  if (after === scans.length) return after - 1;
  return (scans[after] as number) - scan < scan - (scans[after - 1] as number) ? after : after - 1;
}

const word = new BigUint64Array(1);
const wordView = new DataView(word.buffer);

/** The text of a value; empty where there is none. */
export function textAt(samples: Samples, row: number, index: number, signal: TraceSignal): string {
  const value = samples.columns[index]?.[row];
  if (row < 0 || value === undefined || (Number.isNaN(value) && signal.kind !== "real")) return "";
  if (Number.isNaN(value) && samples.raw[index]?.[row] === 0n) return "";
  word[0] = samples.raw[index]?.[row] ?? 0n;
  return formatValue(shapeOf(signal), wordView, 0);
}

/** The points to draw for a stretch: at most two for each pixel, the least and the greatest value in their order. */
export interface Drawn {
  xs: number[];
  ys: (number | null)[][];
}

const orNull = (value: number | undefined) => (value === undefined || Number.isNaN(value) ? null : value);

export function perPixel(samples: Samples, which: readonly number[], { from, to }: Range, pixels: number): Drawn {
  const { scans, columns } = samples;
  const low = Math.max(0, lowerBound(scans, from) - 1);
  const high = Math.min(scans.length, lowerBound(scans, to) + 1);
  const count = high - low;
  if (count <= 2 * pixels) {
    const xs = Array.from(scans.subarray(low, high));
    return { xs, ys: which.map((index) => Array.from(columns[index]?.subarray(low, high) ?? [], orNull)) };
  }
  const starts = buckets(scans, low, high, from, to, pixels);
  const xs: number[] = [];
  for (let bucket = 0; bucket + 1 < starts.length; bucket += 1) {
    xs.push(scans[starts[bucket] as number] as number, scans[(starts[bucket + 1] as number) - 1] as number);
  }
  return { xs, ys: which.map((index) => extremes(columns[index] ?? new Float64Array(0), starts)) };
}

/** Where the rows of each pixel begin, and where those of the last pixel end. */
function buckets(scans: Float64Array, low: number, high: number, from: number, to: number, pixels: number): number[] {
  const width = (to - from) / pixels;
  const starts: number[] = [];
  let last = Number.NEGATIVE_INFINITY;
  for (let row = low; row < high; row += 1) {
    const pixel = Math.floor(((scans[row] as number) - from) / width);
    if (pixel !== last) {
      starts.push(row);
      last = pixel;
    }
  }
  starts.push(high);
  return starts;
}

function extremes(column: Float64Array, starts: readonly number[]): (number | null)[] {
  const ys: (number | null)[] = [];
  for (let bucket = 0; bucket + 1 < starts.length; bucket += 1) {
    const begin = starts[bucket] as number;
    const end = starts[bucket + 1] as number;
    let least = Number.POSITIVE_INFINITY;
    let most = Number.NEGATIVE_INFINITY;
    let atLeast = begin;
    let atMost = begin;
    for (let row = begin; row < end; row += 1) {
      const value = column[row] as number;
      if (value < least) {
        least = value;
        atLeast = row;
      }
      if (value > most) {
        most = value;
        atMost = row;
      }
    }
    if (least > most) ys.push(null, null);
    else if (atLeast <= atMost) ys.push(least, most);
    else ys.push(most, least);
  }
  return ys;
}

/** The least and greatest finite values among the points to draw; null where there are none. */
export function bounds(columns: readonly (readonly (number | null)[])[]): Range | null {
  let from = Number.POSITIVE_INFINITY;
  let to = Number.NEGATIVE_INFINITY;
  for (const column of columns) {
    for (const value of column) {
      if (value === null || !Number.isFinite(value)) continue;
      if (value < from) from = value;
      if (value > to) to = value;
    }
  }
  return from <= to ? { from, to } : null;
}
