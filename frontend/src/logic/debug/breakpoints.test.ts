import { describe, expect, it } from "vitest";
import type { BreakpointInfo } from "../../wire/types";
import { conditionsOf, PLAIN, placeOf, sayBreakpoint, shapeOf } from "./breakpoints";

const at = (change: Partial<BreakpointInfo>): BreakpointInfo => ({
  ...PLAIN,
  id: 1,
  author: "Ann",
  group: "",
  file: "fb/FB_Belt.st",
  line: 12,
  verified: true,
  message: "",
  at_line: 12,
  column: 0,
  at_column: 3,
  reached: 0,
  ...change,
});

describe("the drawing of a breakpoint", () => {
  it("shows its kind", () => {
    expect(shapeOf(at({}))).toBe("bp");
    expect(shapeOf(at({ condition: "a > 1" }))).toBe("bp-cond");
    expect(shapeOf(at({ instance: "Main.belt[3]" }))).toBe("bp-cond");
    expect(shapeOf(at({ log: "level {level}", condition: "a" }))).toBe("bp-log");
    expect(shapeOf(at({ assign: "a := 1;" }))).toBe("bp-assign");
    expect(shapeOf(at({ kind: "data", path: "Main.level" }))).toBe("bp-data");
  });

  it('shows "disabled" first, then "not in the program"', () => {
    expect(shapeOf(at({ enabled: false, verified: false, log: "x" }))).toBe("bp-off");
    expect(shapeOf(at({ verified: false, condition: "x" }))).toBe("bp-unbound");
  });
});

describe("the description of a breakpoint", () => {
  it("names the place according to the kind", () => {
    expect(placeOf(at({}))).toBe("FB_Belt");
    const pous = [
      { name: "Valve", kind: "function_block", file: "fb/FB_Belt.st", line: 1 },
      { name: "Seat", kind: "function_block", file: "fb/FB_Belt.st", line: 10 },
      { name: "Cell", kind: "function_block", file: "fb/FB_Belt.st", line: 13 },
    ] as const;
    expect(placeOf(at({}), pous)).toBe("Seat");
    // Until a statement is found for it, the place is the requested one.
    expect(placeOf(at({ line: 20, at_line: 0 }), pous)).toBe("Cell");
    expect(placeOf(at({ kind: "data", path: "Main.level" }))).toBe("Main.level");
    expect(placeOf(at({ kind: "error", error: "" }))).toBe("any error");
    expect(placeOf(at({ kind: "scan", scan: 4711 }))).toBe("scan 4711");
  });

  it("lists what restricts it", () => {
    expect(conditionsOf(at({ condition: "jam.Q", hits: "% 3", instance: "Main.belt[3]" }))).toBe(
      "if jam.Q · hits % 3 · in Main.belt[3]",
    );
    expect(conditionsOf(at({ enabled: false }))).toBe("disabled");
  });

  it("says why it is not in the program, how often it was hit, and who set it", () => {
    const said = sayBreakpoint(at({ verified: false, message: "line 12 has no statement", reached: 3 }));
    expect(said).toContain("line 12 has no statement");
    expect(said).toContain("3");
    expect(said).toContain("Ann");
  });
});
