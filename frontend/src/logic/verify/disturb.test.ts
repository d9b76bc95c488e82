import { describe, expect, it } from "vitest";
import { type DisturbForm, ENDLESS, isSeeded, plainDisturbance, readChance, readDisturbance } from "./disturb";

const read = (change: Partial<DisturbForm>, now = 0) => readDisturbance({ ...plainDisturbance, ...change }, now);

describe("a probability", () => {
  it("is read as a fraction, in percent, or as one in so many", () => {
    expect(readChance("0.001")).toBe(0.001);
    expect(readChance("0,5")).toBe(0.5);
    expect(readChance("0.1 %")).toBeCloseTo(0.001);
    expect(readChance("1/1 000")).toBe(0.001);
    expect(readChance("1")).toBe(1);
  });
  it("must be between 0 and 1, and a number", () => {
    for (const text of ["", "0", "0 %", "1.1", "101 %", "1/0", "often", "-1 %", "1/2/3", "1.2.3"])
      expect(readChance(text), text).toBeNull();
  });
});

describe("a bit flip", () => {
  it("needs a variable", () => {
    expect(read({}).troubles).toEqual({ path: "disturb.bad.path" });
    expect(read({ path: " D120 " })).toMatchObject({ wanted: { path: "D120", bit: null, seed: 1 }, troubles: {} });
  });
  it("lets the seed choose the bit unless it is given", () => {
    expect(read({ path: "D120", bit: "15", seed: "nonsense" })).toMatchObject({
      wanted: { bit: 15, seed: 0 },
      troubles: {},
    });
    expect(isSeeded({ ...plainDisturbance, bit: "3" })).toBe(false);
    expect(isSeeded({ ...plainDisturbance, bit: "3", when: "chance" })).toBe(true);
    expect(read({ path: "D120", seed: "" }).troubles).toEqual({ seed: "shape.bad.count" });
  });
  it("has a bit number up to 1023", () => {
    expect(read({ path: "D120", bit: "1024" }).troubles).toEqual({ bit: "disturb.bad.bit" });
    expect(read({ path: "D120", bit: "x" }).troubles).toEqual({ bit: "disturb.bad.bit" });
  });
});

describe("when", () => {
  it("needs nothing for the next scan, and ignores the fields of the other choices", () => {
    expect(read({ path: "D1", when: "next", scan: "bad", chance: "bad", times: "bad" })).toMatchObject({
      wanted: { scan: null, probability: 0, times: 0 },
      troubles: {},
    });
  });
  it("refuses a scan that is over", () => {
    expect(read({ path: "D1", when: "scan", scan: "4 711" }, 4711)).toMatchObject({
      wanted: { scan: 4711 },
      troubles: {},
    });
    expect(read({ path: "D1", when: "scan", scan: "4710" }, 4711).troubles).toEqual({ scan: "shape.bad.past" });
    expect(read({ path: "D1", when: "scan", scan: "" }).troubles).toEqual({ scan: "shape.bad.scan" });
  });
  it("accepts a probability from a scan on, unlimited or at most so many times", () => {
    expect(read({ path: "D1", when: "chance", chance: "1/500", scan: "10", times: "" }, 99)).toMatchObject({
      wanted: { probability: 0.002, scan: 10, times: 0, seed: 1 },
      troubles: {},
    });
    expect(read({ path: "D1", when: "chance", chance: "2", times: "0" }).troubles).toEqual({
      chance: "disturb.bad.chance",
      times: "shape.bad.count",
    });
  });
});

describe("a stuck input", () => {
  it("may be all inputs, for some scans or until it is taken back", () => {
    expect(read({ kind: "stuck", endless: true, scans: "bad" })).toMatchObject({
      wanted: { path: "", scans: ENDLESS, bit: null, seed: 0 },
      troubles: {},
    });
    expect(read({ kind: "late", endless: true, scans: "3" }).wanted.scans).toBe(3);
    expect(read({ kind: "late", scans: "0" }).troubles).toEqual({ scans: "shape.bad.count" });
  });
});

describe("the result of a statement", () => {
  it("needs a file and a line, and no path", () => {
    expect(read({ kind: "result", path: "D1", site: "Main.st" }).troubles).toEqual({ site: "shape.bad.place" });
    expect(read({ kind: "result", path: "D1", site: "lib/Main.st:34", bit: "6" })).toMatchObject({
      wanted: { path: "", site: "lib/Main.st:34", bit: 6, seed: 0 },
      troubles: {},
    });
  });
});
