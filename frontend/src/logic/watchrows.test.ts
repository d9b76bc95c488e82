import { describe, expect, it } from "vitest";
import type { PlcSymbol } from "../wire/types";
import { pathsToWatch, watchRows } from "./watchrows";

const symbol = (path: string, expandable = false) => ({ path, name: path, expandable }) as PlcSymbol;

const view = {
  roots: ["Main.belt", "A402"],
  open: new Set(["Main.belt", "Main.belt[1]"]),
  members: new Map([
    ["Main.belt", [symbol("Main.belt[1]", true), symbol("Main.belt[2]", true)]],
    ["Main.belt[1]", [symbol("Main.belt[1].run")]],
  ]),
  symbols: new Map([["Main.belt", symbol("Main.belt", true)]]),
  notes: new Map([["A402", { kind: "refused" as const, message: "read-only", near: [] }]]),
  refusals: new Map(),
};

describe("watchRows", () => {
  it("unfolds members below their owner and puts notes below their row", () => {
    expect(watchRows(view).map((row) => [row.kind, row.path, row.level])).toEqual([
      ["value", "Main.belt", 0],
      ["value", "Main.belt[1]", 1],
      ["value", "Main.belt[1].run", 2],
      ["value", "Main.belt[2]", 1],
      ["value", "A402", 0],
      ["note", "A402", 0],
    ]);
  });

  it("says what is not known, and what it may have meant", () => {
    const refusals = new Map([["Main.belt", { message: "no such variable", near: ["Main.belts"] }]]);
    const rows = watchRows({ ...view, open: new Set(), refusals });
    expect(rows[1]).toMatchObject({ kind: "note", note: { kind: "unknown", near: ["Main.belts"] } });
  });

  it("watches entries and the values that are shown, but no structures inside", () => {
    expect(pathsToWatch(watchRows(view))).toEqual(["Main.belt", "Main.belt[1].run", "A402"]);
  });
});
