import { expect, it } from "vitest";
import { chartsOf, lanePath, lengthsOf, type Stretch, stretchAt, stretchesOf } from "./lanes";

const _ = Number.NaN;
const lane = (values: readonly number[], scans = values.map((_value, index) => 10 + index), every = 1) =>
  stretchesOf(Float64Array.from(scans), Float64Array.from(values), every);
const brief = (stretches: readonly Stretch[]) =>
  stretches.map(({ from, to, begins, ends }) => `${begins ? "[" : "("}${from}-${to}${ends ? "]" : ")"}`);

it.each([
  [
    [0, 1, 1, 0, 1, 0],
    ["[11-12]", "[14-14]"],
  ],
  [
    [1, 1, 0, 0, 0, 1],
    ["(10-11]", "[15-15)"],
  ],
  // What was not sampled may have been anything.
  [
    [0, 1, _, 1, 0, 0],
    ["[11-11)", "(13-13]"],
  ],
  [[0, 0], []],
])("%j was active in %j", (values, wanted) => {
  expect(brief(lane(values))).toEqual(wanted);
});

it("ends a stretch where samples are missing", () => {
  expect(brief(lane([0, 1, 1, 0], [10, 11, 20, 21]))).toEqual(["[11-11)", "(20-20]"]);
  expect(brief(lane([0, 1, 1, 0], [10, 15, 20, 25], 5))).toEqual(["[15-20]"]);
});

it("takes lengths only from stretches whose beginning and end were seen", () => {
  const stretches = lane([1, 0, 1, 1, 0, 1, 0, 1]);
  expect(lengthsOf(stretches)).toEqual({ times: 4, last: 1, least: 1, most: 2 });
  expect(lengthsOf(lane([1, 1]))).toEqual({ times: 1, last: null, least: null, most: null });
  expect([stretchAt(stretches, 12.4)?.from, stretchAt(stretches, 14)]).toEqual([12, undefined]);
});

it("draws what is closer than a pixel as one bar, and leaves nothing out", () => {
  const one: Stretch = { from: 100, to: 149, begins: true, ends: true };
  expect(lanePath([one], 0, 999, 1000, 9)).toBe("M100 0H150V9H100z");
  expect(lanePath([{ ...one, to: 100 }], 0, 99_999, 1000, 9)).toBe("M1 0H3V9H1z");
  const many = Array.from({ length: 5000 }, (_value, index) => ({ ...one, from: 2 * index, to: 2 * index }));
  expect(lanePath(many, 0, 9999, 1000, 9)).toBe("M0 0H999.9V9H0z");
  expect(lanePath([one], 200, 300, 1000, 9)).toBe("");
});

it("knows the steps of the charts of a file", () => {
  const text = "PROGRAM P\nINITIAL_STEP A: END_STEP\nSTEP B: END_STEP\nEND_PROGRAM\n";
  expect(chartsOf(text).map(({ steps }) => steps.map(({ name }) => name))).toEqual([["A", "B"]]);
  expect(chartsOf("PROGRAM P\nSTEP A: x(\nEND_PROGRAM\n")).toEqual([]);
});
