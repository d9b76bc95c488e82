import { describe, expect, it } from "vitest";
import { grouped, interval, microseconds, plcTime } from "./numbers";

describe("numbers", () => {
  it("groups thousands", () => {
    expect(grouped(128411)).toBe("128\u2009411");
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
});
