import { describe, expect, it } from "vitest";
import { axisMarks } from "./axis";
import type { AxisUnit } from "./plots";
import { padded } from "./plots";

const S = 1e9;
const DAY = 86_400 * S;
const texts = (from: number, to: number, count: number, unit: AxisUnit) =>
  axisMarks({ from, to }, count, unit).map(({ text }) => text);

describe("the axis", () => {
  it("has numbers for numbers", () => {
    expect(texts(0, 10, 5, "number")).toEqual(["0", "2", "4", "6", "8", "10"]);
  });

  it("has durations with units, in steps that are usual for clocks", () => {
    expect(texts(0, 2 * S, 4, "time")).toEqual(["0s", "500ms", "1s", "1s500ms", "2s"]);
    expect(texts(0, 100 * S, 4, "time")).toEqual(["0s", "30s", "1m", "1m30s"]);
    expect(texts(-1000, 1000, 2, "time")).toEqual(["-1us", "0s", "1us"]);
    expect(texts(0, 5, 2, "time")).toEqual(["0s", "5ns"]);
    expect(texts(0, 30 * DAY, 3, "time")).toEqual(["0s", "10d", "20d", "30d"]);
  });

  it("breaks a duration that is longer than the room beside it", () => {
    expect(texts(119.9995 * S, 119.99951 * S, 1, "time")).toEqual(["1m59s999ms\n500us", "1m59s999ms\n510us"]);
  });

  it("has days, and nothing in between", () => {
    const day = (count: number) => 20_000 * DAY + count * DAY;
    expect(texts(day(0), day(2), 8, "date")).toEqual(["2024-10-04", "2024-10-05", "2024-10-06"]);
    const constant = padded({ from: day(0), to: day(0) }, "date");
    expect(texts(constant.from, constant.to, 4, "date")).toEqual(["2024-10-03", "2024-10-04", "2024-10-05"]);
  });

  it("ends with the day for times of day", () => {
    expect(texts(-3600 * S, 26 * 3600 * S, 4, "clock")).toEqual(["00:00:00", "12:00:00"]);
  });

  it("is exact for dates and times, though a double cannot hold these nanoseconds", () => {
    const from = 20_000 * DAY + 45_000 * S;
    expect(texts(from, from + 0.2 * S, 2, "moment")).toEqual([
      "2024-10-04\n12:30:00",
      "2024-10-04\n12:30:00.1",
      "2024-10-04\n12:30:00.2",
    ]);
  });
});
