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
  at_column: 3,
  reached: 0,
  ...change,
});

describe("the shape of a breakpoint", () => {
  it("tells its kind", () => {
    expect(shapeOf(at({}))).toBe("bp");
    expect(shapeOf(at({ condition: "a > 1" }))).toBe("bp-cond");
    expect(shapeOf(at({ instance: "Main.belt[3]" }))).toBe("bp-cond");
    expect(shapeOf(at({ log: "level {level}", condition: "a" }))).toBe("bp-log");
    expect(shapeOf(at({ assign: "a := 1;" }))).toBe("bp-assign");
    expect(shapeOf(at({ kind: "data", path: "Main.level" }))).toBe("bp-data");
  });

  it("tells first that it is off, then that it is nowhere", () => {
    expect(shapeOf(at({ enabled: false, verified: false, log: "x" }))).toBe("bp-off");
    expect(shapeOf(at({ verified: false, condition: "x" }))).toBe("bp-unbound");
  });
});

describe("the words of a breakpoint", () => {
  it("name the place by its kind", () => {
    expect(placeOf(at({}))).toBe("FB_Belt");
    const pous = [
      { name: "Valve", kind: "function_block", file: "fb/FB_Belt.st", line: 1 },
      { name: "Seat", kind: "function_block", file: "fb/FB_Belt.st", line: 10 },
      { name: "Cell", kind: "function_block", file: "fb/FB_Belt.st", line: 13 },
    ] as const;
    expect(placeOf(at({}), pous)).toBe("Seat");
    // As asked for, until it has found its statement.
    expect(placeOf(at({ line: 20, at_line: 0 }), pous)).toBe("Cell");
    expect(placeOf(at({ kind: "data", path: "Main.level" }))).toBe("Main.level");
    expect(placeOf(at({ kind: "error", error: "" }))).toBe("any error");
    expect(placeOf(at({ kind: "scan", scan: 4711 }))).toBe("scan 4711");
  });

  it("list what narrows it", () => {
    expect(conditionsOf(at({ condition: "jam.Q", hits: "% 3", instance: "Main.belt[3]" }))).toBe(
      "if jam.Q · hits % 3 · in Main.belt[3]",
    );
    expect(conditionsOf(at({ enabled: false }))).toBe("disabled");
  });

  it("say why it is nowhere, how often it was reached, and whose it is", () => {
    const said = sayBreakpoint(at({ verified: false, message: "line 12 has no statement", reached: 3 }));
    expect(said).toContain("line 12 has no statement");
    expect(said).toContain("3");
    expect(said).toContain("Ann");
  });
});
