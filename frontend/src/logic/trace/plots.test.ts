import { describe, expect, it } from "vitest";
import type { TraceSignal } from "../../wire/types";
import { axisText, lastName, layoutOf, padded, spanText, ticks, within, zoomedAt } from "./plots";

const signal = (text: string, kind = "int"): TraceSignal => ({
  text,
  type: "",
  kind,
  size: 2,
  values: [],
  message: "",
});

describe("plots", () => {
  it("group signals with the same last name, and give BOOLs a lane each", () => {
    const { plots, lanes } = layoutOf(
      ["belt[1].speed", "belt[2].speed", "zone[2].parts", "Main.a + Main.b"]
        .map((text) => signal(text))
        .concat([signal("belt[1].run", "bool"), signal("W10.03", "bool")]),
      new Map(),
    );
    expect(plots.map(({ title, lines }) => [title, lines.map(({ name }) => name)])).toEqual([
      ["speed", ["belt[1]", "belt[2]"]],
      ["zone[2].parts", ["parts"]],
      ["Main.a + Main.b", ["Main.a + Main.b"]],
    ]);
    expect(lanes.map(({ name }) => name)).toEqual(["belt[1].run", "W10.03"]);
    expect(plots.flatMap(({ lines }) => lines.map(({ color }) => color))).toEqual([1, 2, 3, 4]);
  });

  it("take the signals that are dragged to them", () => {
    const signals = [signal("a.speed"), signal("b.parts")];
    const { plots } = layoutOf(signals, new Map([["b.parts", "SPEED"]]));
    expect(plots.map(({ lines }) => lines.map(({ signal: { text } }) => text))).toEqual([["a.speed", "b.parts"]]);
  });

  it("have one unit each: a duration shares no axis with a number, even if it is dragged there", () => {
    const of = (text: string, kind: string, type = "") => ({ ...signal(text, kind), type });
    const signals = [
      of("a.v", "int"),
      of("b.v", "time", "LTIME"),
      of("c.v", "time", "TIME"),
      of("d.v", "date", "LDATE"),
      of("e.v", "date", "LTIME_OF_DAY"),
      of("f.v", "date", "DATE_AND_TIME"),
      of("g.x", "time", "TIME"),
      of("h.x", "time", "TIME"),
    ];
    const { plots } = layoutOf(signals, new Map([["g.x", "V"]]));
    expect(plots.map(({ unit, lines }) => [unit, lines.map(({ signal: { text } }) => text)])).toEqual([
      ["number", ["a.v"]],
      ["time", ["b.v", "c.v", "g.x"]],
      ["date", ["d.v"]],
      ["clock", ["e.v"]],
      ["moment", ["f.v"]],
      ["time", ["h.x"]],
    ]);
  });

  it("are empty without signals", () => {
    expect(layoutOf([], new Map())).toEqual({ plots: [], lanes: [] });
  });

  it("use dashes to distinguish lines when all colours are used", () => {
    const { plots } = layoutOf(
      Array.from({ length: 8 }, (_, at) => signal(`m[${at}].x`)),
      new Map(),
    );
    const looks = plots.flatMap(({ lines }) => lines.map(({ color, dash }) => `${color} ${dash}`));
    expect(new Set(looks).size).toBe(8);
  });
});

describe("axes", () => {
  it("have round numbers", () => {
    expect(ticks({ from: 0, to: 10 }, 5)).toEqual([0, 2, 4, 6, 8, 10]);
    expect(ticks({ from: 128_177, to: 128_411 }, 6, true)).toEqual([128_200, 128_250, 128_300, 128_350, 128_400]);
    expect(ticks({ from: 5, to: 5 }, 4)).toEqual([5]);
    expect(ticks({ from: 0, to: 3 }, 10, true)).toEqual([0, 1, 2, 3]);
  });
  it("have short numbers", () => {
    expect([0.1 + 0.2, 1_234_567, 0, -400, 0.00001].map(axisText)).toEqual(["0.3", "1.2e6", "0", "-400", "1.0e-5"]);
  });
  it("leave room above and below, also around a constant", () => {
    expect(padded({ from: 5, to: 5 })).toEqual({ from: 4, to: 6 });
    expect(padded(null)).toEqual({ from: 0, to: 1 });
  });
});

it("last names", () => {
  expect(["Main.belt[1].speed", "D100", "Main.a[3]", "Main.a + 1"].map(lastName)).toEqual([
    "speed",
    "D100",
    "a",
    "Main.a + 1",
  ]);
});

it("keeps a part of the whole inside the whole", () => {
  const whole = { from: 0, to: 1000 };
  expect(within({ from: -50, to: 50 }, whole)).toEqual({ from: 0, to: 100 });
  expect(within({ from: 950, to: 1050 }, whole)).toEqual({ from: 900, to: 1000 });
  expect(zoomedAt({ from: 0, to: 1000 }, whole, 0.5, 500)).toEqual({ from: 250, to: 750 });
  expect(zoomedAt({ from: 250, to: 750 }, whole, 4, 500)).toEqual(whole);
});

it("spans of time", () => {
  expect([3e11, 1.2e8, 5e3, 0, -1.5e9].map(spanText)).toEqual(["5 min", "120 ms", "5 µs", "0 ns", "-1.5 s"]);
});
