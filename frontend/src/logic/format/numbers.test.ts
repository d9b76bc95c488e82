import { describe, expect, it } from "vitest";
import { bytes, duration, grouped, interval, microseconds, percent, plcTime, ungrouped } from "./numbers";

describe("numbers", () => {
  it("groups thousands", () => {
    expect(grouped(128411)).toBe("128,411");
    for (const typed of ["128411", " 128,411 ", "128 411", "128\u2009411"]) expect(ungrouped(typed)).toBe("128411");
    for (const other of ["1,5", "12,34", ",123", "1.5", "x"]) expect(ungrouped(other)).toBe(other);
    expect(grouped(999)).toBe("999");
  });

  it("shows PLC time", () => {
    expect(plcTime(1_284_110_000_000)).toBe("00:21:24.110");
    expect(plcTime(86_400_000_000_000 * 2)).toBe("2d 00:00:00.000");
  });

  it("shows durations with three digits", () => {
    expect(microseconds(0.84)).toBe("0.84 µs");
    expect(microseconds(84.2)).toBe("84.2 µs");
    expect(microseconds(1120)).toBe("1.12 ms");
    expect(interval(10_000_000)).toBe("10 ms");
    expect(interval(500_000)).toBe("500 µs");
    expect(interval(1_000_000_000)).toBe("1 s");
  });

  it("sizes, lengths and shares", () => {
    expect([0, 999, 1000, 65_536, 67_108_864, 3_221_225_472].map(bytes)).toEqual([
      "0 B",
      "999 B",
      "1.0 KiB",
      "64 KiB",
      "64 MiB",
      "3.0 GiB",
    ]);
    expect([42e6, 21.44e9, 363e9, 7800e9, 273_600e9].map(duration)).toEqual([
      "42 ms",
      "21.4 s",
      "6 min 3 s",
      "2 h 10 min",
      "3 d 4 h",
    ]);
    expect([0, 0.42, 12.3].map(percent)).toEqual(["0 %", "0.4 %", "12 %"]);
  });
});
