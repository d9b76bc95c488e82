import { describe, expect, it } from "vitest";
import type { TraceSignal } from "../../wire/types";
import { appended, bounds, decode, lowerBound, nearestRow, perPixel, rowAt, type Samples, textAt } from "./samples";

const signal = (text: string, type: string, kind: string, size: number): TraceSignal => ({
  text,
  type,
  kind,
  size,
  values: [],
  message: "",
});
const SIGNALS = [
  signal("Main.n", "INT", "int", 2),
  signal("Main.on", "BOOL", "bool", 1),
  signal("Main.r", "REAL", "real", 4),
  signal("Main.big", "LINT", "int", 8),
];

/** Bytes as the backend packs them. */
function packed(rows: { scan: number; valid: number; values: bigint[] }[], decimated = false): ArrayBuffer {
  const count = rows[0]?.values.length ?? 0;
  const buffer = new ArrayBuffer(32 + 8 * rows.length * (2 + count));
  const view = new DataView(buffer);
  view.setUint8(0, 2);
  view.setUint8(1, decimated ? 1 : 0);
  view.setUint16(2, count, true);
  view.setUint32(4, rows.length, true);
  view.setBigUint64(8, 3n, true);
  view.setBigUint64(16, 900n, true);
  view.setBigUint64(24, 7n, true);
  const put = (column: number, row: number, value: bigint) =>
    view.setBigUint64(32 + 8 * (column * rows.length + row), value, true);
  rows.forEach(({ scan, valid, values }, row) => {
    put(0, row, BigInt(scan));
    put(1, row, BigInt(valid));
    values.forEach((value, index) => void put(2 + index, row, value));
  });
  return buffer;
}

const float = (value: number) => BigInt(new Uint32Array(new Float32Array([value]).buffer)[0] ?? 0);

function line(from: number, count: number, value: (scan: number) => number): Samples {
  const scans = Float64Array.from({ length: count }, (_, at) => from + at);
  const column = scans.map(value);
  return {
    first: from,
    end: from + count,
    generation: 1,
    decimated: false,
    scans,
    columns: [column],
    raw: [BigUint64Array.from(column, (each) => BigInt.asUintN(16, BigInt(Math.round(each || 0))))],
  };
}

describe("samples", () => {
  it("are read in every type, and are NaN where they are not valid", () => {
    const samples = decode(
      packed([
        { scan: 10, valid: 0b1111, values: [65534n, 1n, float(1.5), (1n << 64n) - 3n] },
        { scan: 11, valid: 0b1010, values: [0n, 0n, 0n, 9007199254740993n] },
      ]),
      SIGNALS,
    );
    expect([samples.first, samples.end, samples.generation, samples.decimated]).toEqual([3, 900, 7, false]);
    expect([...samples.scans]).toEqual([10, 11]);
    expect(samples.columns.map((column) => column[0])).toEqual([-2, 1, 1.5, -3]);
    expect(samples.columns.map((column) => column[1])).toEqual([Number.NaN, 0, Number.NaN, 9007199254740992]);
    const texts = (row: number) => SIGNALS.map((one, index) => textAt(samples, row, index, one));
    expect(texts(0)).toEqual(["-2", "TRUE", "1.5", "-3"]);
    expect(texts(1)).toEqual(["", "FALSE", "", "9007199254740993"]);
  });

  it("continue, and the oldest are dropped", () => {
    const joined = appended(
      line(0, 10, (scan) => scan),
      line(10, 5, (scan) => scan),
      12,
    );
    expect([...joined.scans]).toEqual([3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14]);
    expect([...(joined.columns[0] ?? [])]).toEqual([...joined.scans]);
    expect(joined.end).toBe(15);
  });

  it("are found by their scans", () => {
    const samples = { ...line(0, 5, () => 0), scans: Float64Array.from([0, 10, 20, 30, 40]) };
    expect(lowerBound(samples.scans, 11)).toBe(2);
    expect([rowAt(samples, 19), rowAt(samples, 20), rowAt(samples, -1)]).toEqual([1, 2, -1]);
    expect([nearestRow(samples, 14), nearestRow(samples, 16), nearestRow(samples, 99)]).toEqual([1, 2, 4]);
  });
});

describe("the points to draw", () => {
  it("are all samples where there is room", () => {
    const drawn = perPixel(
      line(0, 100, (scan) => scan),
      [0],
      { from: 10, to: 20 },
      400,
    );
    expect(drawn.xs).toEqual([9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20]);
  });

  it("keep every peak, with at most two points a pixel", () => {
    const samples = line(0, 100_000, (scan) => (scan === 54_321 ? 99 : scan === 54_400 ? -99 : Math.sin(scan / 1000)));
    const drawn = perPixel(samples, [0], { from: 0, to: 99_999 }, 500);
    expect(drawn.xs.length).toBeLessThanOrEqual(1002);
    expect(bounds(drawn.ys)).toEqual({ from: -99, to: 99 });
    const peaks = (drawn.ys[0] ?? []).filter((value) => Math.abs(value ?? 0) === 99);
    expect(peaks).toEqual([99, -99]); // in the order of the samples
    for (let at = 1; at < drawn.xs.length; at += 1) expect(drawn.xs[at]).toBeGreaterThanOrEqual(drawn.xs[at - 1] ?? 0);
  });

  it("have gaps where there are no samples", () => {
    const samples = line(0, 10_000, (scan) => (scan < 5000 ? Number.NaN : 1));
    const drawn = perPixel(samples, [0], { from: 0, to: 9999 }, 100);
    expect(drawn.ys[0]?.[0]).toBeNull();
    expect(drawn.ys[0]?.at(-1)).toBe(1);
  });
});
