import { describe, expect, it } from "vitest";
import type { Mark } from "../../wire/types";
import {
  around,
  closeTo,
  clusters,
  countKinds,
  including,
  neighbour,
  placeOf,
  readScan,
  readTime,
  scanAt,
  spanOn,
  stepTo,
  ticks,
  withDifferences,
  zoomed,
} from "./timeline";

const axis = { from: 1000, to: 2000 };
const mark = (scan: number, kind: Mark["kind"] = "write"): Mark => ({ scan, kind, author: "Ann", text: `${kind}` });

describe("the position of a scan", () => {
  it("goes from edge to edge and back", () => {
    expect(placeOf(1000, axis)).toBe(0);
    expect(placeOf(1500, axis)).toBe(0.5);
    expect(placeOf(9999, axis)).toBe(1);
    expect(scanAt(0.25, axis)).toBe(1250);
    expect(scanAt(-1, axis)).toBe(1000);
    expect(scanAt(2, axis)).toBe(2000);
  });

  it("is at the end for a run without scans", () => {
    expect(placeOf(0, { from: 0, to: 0 })).toBe(1);
    expect(scanAt(0.5, { from: 0, to: 0 })).toBe(0);
  });
});

describe("ticks", () => {
  it("are round numbers with room between them", () => {
    expect(ticks({ from: 0, to: 128_411 }, 1000)).toEqual([0, 20_000, 40_000, 60_000, 80_000, 100_000, 120_000]);
    expect(ticks({ from: 4711, to: 4731 }, 1000)).toEqual([4712, 4714, 4716, 4718, 4720, 4722, 4724, 4726, 4728, 4730]);
  });

  it("are whole scans, and none where there is no axis", () => {
    expect(ticks({ from: 0, to: 3 }, 1000)).toEqual([0, 1, 2, 3]);
    expect(ticks({ from: 5, to: 5 }, 1000)).toEqual([]);
    expect(ticks(axis, 0)).toEqual([1000, 2000]);
  });
});

describe("clusters", () => {
  it("combine marks that are too close; the most severe mark gives the icon", () => {
    const found = clusters([mark(1000), mark(1001, "error"), mark(1002), mark(1500, "force")], axis, 320);
    expect(found.map(({ first, marks }) => [first.kind, first.scan, marks.length])).toEqual([
      ["error", 1001, 3],
      ["force", 1500, 1],
    ]);
    expect(found.map(({ place }) => place)).toEqual([0, 0.5]);
  });

  it("omit marks outside the axis, and lose none inside", () => {
    const many = Array.from({ length: 5000 }, (_, index) => mark(index));
    const found = clusters(many, axis, 1000);
    expect(found.reduce((sum, { marks }) => sum + marks.length, 0)).toBe(1001);
    const places = found.map(({ place }) => place * 1000);
    for (const [index, place] of places.entries())
      if (index > 0) expect(place - (places[index - 1] ?? 0)).toBeGreaterThanOrEqual(16);
  });

  it("keep a group at the right edge inside, and a single mark at its place", () => {
    const [group] = clusters([mark(2000), mark(2000)], axis, 1000, 42);
    expect(group?.place).toBeCloseTo(0.974);
    expect(clusters([mark(2000)], axis, 1000, 42)[0]?.place).toBe(1);
    const joined = clusters([mark(1950), mark(2000), mark(2000)], axis, 1000, 42);
    expect(joined.map(({ marks }) => marks.length)).toEqual([3]);
  });

  it("can be enlarged until all marks of a group are at one scan", () => {
    const whole = { from: 0, to: 10_000 };
    expect(around([mark(1000), mark(1100)], whole, whole)).toEqual({ from: 988, to: 1113 });
    expect(around([mark(9990), mark(10_000)], whole, whole)).toEqual({ from: 9980, to: 10_000 });
    expect(around([mark(5), mark(5)], whole, whole)).toBeNull();
    expect(around([mark(988), mark(1110)], { from: 988, to: 1113 }, whole)).toBeNull();
  });

  it("count the kinds of their marks", () => {
    expect(countKinds([mark(1), mark(2, "error"), mark(3)])).toEqual([
      ["error", 1],
      ["write", 2],
    ]);
  });
});

describe("moving", () => {
  it("zooms around a scan, within the run", () => {
    const whole = { from: 0, to: 1000 };
    expect(zoomed(whole, whole, 0.5, 500)).toEqual({ from: 250, to: 750 });
    expect(zoomed(whole, whole, 0.5, 1000)).toEqual({ from: 500, to: 1000 });
    expect(zoomed({ from: 250, to: 750 }, whole, 2, 500)).toBeNull();
    expect(zoomed({ from: 0, to: 20 }, whole, 0.5, 10)).toEqual({ from: 0, to: 20 });
  });

  it("keeps a scan visible", () => {
    const whole = { from: 0, to: 1000 };
    expect(including({ from: 100, to: 200 }, whole, 150)).toEqual({ from: 100, to: 200 });
    expect(including({ from: 100, to: 200 }, whole, 600)).toEqual({ from: 550, to: 650 });
    expect(including({ from: 100, to: 200 }, whole, 1000)).toEqual({ from: 900, to: 1000 });
  });

  it("follows the keys", () => {
    expect(stepTo("ArrowLeft", 1500, axis)).toBe(1499);
    expect(stepTo("PageDown", 1500, axis)).toBe(1600);
    expect(stepTo("PageUp", 1050, axis)).toBe(1000);
    expect(stepTo("ArrowRight", 1999, axis)).toBe("live");
    expect(stepTo("Home", 1500, axis)).toBe(1000);
    expect(stepTo("End", 1500, axis)).toBe("live");
    expect(stepTo("x", 1500, axis)).toBeUndefined();
  });

  it("finds the next mark", () => {
    const marks = [mark(10), mark(20), mark(30)];
    expect(neighbour(marks, 20, 1)?.scan).toBe(30);
    expect(neighbour(marks, 20, -1)?.scan).toBe(10);
    expect(neighbour(marks, 30, 1)).toBeUndefined();
  });

  it("reads a typed scan", () => {
    expect(readScan(" 4711 ")).toBe(4711);
    expect(readScan("12 000")).toBe(12_000);
    expect(readScan("12\u2009000")).toBe(12_000);
    expect(readScan("12,000")).toBe(12_000);
    expect(readScan("1.5")).toBeNull();
    expect(readScan("1,5")).toBeNull();
    expect(readScan("-3")).toBeNull();
    expect(readScan("x1")).toBeNull();
    expect(readScan("")).toBeNull();
  });

  it("reads a typed PLC time", () => {
    expect(readTime("1m2s")).toBe(62e9);
    expect(readTime("1:02")).toBe(62e9);
    expect(readTime("00:01:02.250")).toBe(62.25e9);
    expect(readTime("2d 00:00:01")).toBe((2 * 86_400 + 1) * 1e9);
    expect(readTime("250ms")).toBe(250e6);
    expect(readTime("4711")).toBeNull();
    expect(readTime("")).toBeNull();
    expect(readTime("1:")).toBeNull();
  });
});

describe("stretches on the axis", () => {
  const whole = { from: 0, to: 10_000 };

  it("are enlarged with some room around them", () => {
    const close = closeTo({ from: 4000, to: 5000 }, whole);
    expect(close?.from).toBeLessThan(4000);
    expect(close?.to).toBeGreaterThan(5000);
    expect((close?.to ?? 0) - (close?.from ?? 0)).toBe(1100);
    expect(closeTo({ from: 9990, to: 10_000 }, whole)).toEqual({ from: 9980, to: 10_000 });
    expect(closeTo({ from: 0, to: 9999 }, whole)).toBeNull();
  });

  it("are drawn with their last scan, as far as they are visible", () => {
    expect(spanOn({ from: 0, to: 4999 }, whole)).toEqual({ left: 0, width: 0.5 });
    expect(spanOn({ from: 9000, to: 20_000 }, whole)).toEqual({ left: 0.9, width: expect.closeTo(0.1) });
    expect(spanOn({ from: 20_000, to: 30_000 }, whole)).toBeNull();
  });

  it("have the marks of differences among the others, and these give the icon of a group", () => {
    const difference = { scan: 15, kind: "difference" as const, author: "A", text: "x" };
    const all = withDifferences([mark(10, "write"), mark(20, "write")], [difference]);
    expect(all.map(({ scan }) => scan)).toEqual([10, 15, 20]);
    expect(clusters(all, whole, 100)[0]?.first.kind).toBe("difference");
    expect(countKinds([...all, mark(30, "halt")])).toEqual([
      ["difference", 1],
      ["halt", 1],
      ["write", 2],
    ]);
  });
});
