import { describe, expect, it } from "vitest";
import type { TraceMapping } from "../../wire/types";
import {
  bounded,
  byColumn,
  carryOver,
  changeAxis,
  changeColumn,
  complete,
  countRoles,
  firstValues,
  isProposed,
  takeSaved,
  unused,
} from "./traceImport";

const FILE = ["scan", "start", "speed", "note"];
const proposal: TraceMapping = {
  axis: "scan",
  unit: "scan",
  gaps: "refuse",
  columns: [
    { ...unused("start"), path: "start", role: "input" },
    { ...unused("speed"), path: "Main.belt.speed", role: "output" },
  ],
  sampled: "end",
};
const rows = (mapping: TraceMapping) => mapping.columns.map(({ column, path, role }) => `${column}=${path}:${role}`);

describe("a mapping", () => {
  it("has every column except the axis, in the order of the file", () => {
    expect(rows(complete(proposal, FILE))).toEqual([
      "start=start:input",
      "speed=Main.belt.speed:output",
      "note=:ignore",
    ]);
    expect(complete({ ...proposal, axis: "time" }, FILE).axis).toBe("");
  });

  it("uses a column that gets a variable, unless somebody says otherwise", () => {
    const mapping = complete(proposal, FILE);
    expect(rows(changeColumn(mapping, "note", { path: "lamp" }))).toContain("note=lamp:input");
    expect(rows(changeColumn(mapping, "speed", { path: "x" }))).toContain("speed=x:output");
    const ignored = changeColumn(mapping, "speed", { role: "ignore" });
    expect(rows(ignored)).toContain("speed=Main.belt.speed:ignore");
    expect(rows(changeColumn(ignored, "speed", { path: "y" }))).toContain("speed=y:ignore");
    expect(countRoles(ignored)).toEqual({ inputs: 1, outputs: 0 });
  });

  it("has the old axis among the columns again when a different one is chosen", () => {
    const mapping = changeAxis(complete(proposal, FILE), "note", FILE);
    expect(mapping.axis).toBe("note");
    expect(mapping.columns.map(({ column }) => column)).toEqual(["scan", "start", "speed"]);
    expect(rows(changeAxis(mapping, "", FILE))).toContain("note=:ignore");
  });

  it("says which columns are still as proposed", () => {
    const mapping = changeColumn(complete(proposal, FILE), "speed", { path: "other" });
    expect(mapping.columns.filter((row) => isProposed(row, proposal)).map(({ column }) => column)).toEqual(["start"]);
  });
});

describe("choosing a different file", () => {
  const before = complete(proposal, FILE);

  it("keeps manual changes, and takes the proposal for the rest", () => {
    const changed = { ...changeColumn(before, "speed", { path: "mine" }), gaps: "hold" as const };
    const next: TraceMapping = {
      axis: "t",
      unit: "ms",
      gaps: "refuse",
      columns: [{ ...unused("start"), path: "Main.start", role: "input" }],
      sampled: "end",
    };
    const mapping = carryOver({ mapping: changed, proposal }, next, ["t", "speed", "start"]);
    expect(mapping).toMatchObject({ axis: "t", unit: "ms", gaps: "hold" });
    expect(rows(mapping)).toEqual(["speed=mine:output", "start=Main.start:input"]);
  });

  it("takes the proposal when there was no mapping", () => {
    expect(carryOver(null, proposal, FILE)).toEqual(before);
  });

  it("drops an axis that the file does not have", () => {
    const byHand = changeAxis(before, "note", FILE);
    expect(carryOver({ mapping: byHand, proposal }, proposal, ["scan", "start"]).axis).toBe("scan");
  });
});

describe("a saved mapping", () => {
  it("reports the columns that the file does not have", () => {
    const saved = {
      ...proposal,
      axis: "t",
      columns: [...proposal.columns, { ...unused("lift"), path: "lift", role: "input" as const }],
    };
    const taken = takeSaved(saved, FILE);
    expect(taken.lost).toEqual(["t", "lift"]);
    expect(rows(taken.mapping)).toEqual([
      "scan=:ignore",
      "start=start:input",
      "speed=Main.belt.speed:output",
      "note=:ignore",
    ]);
  });
});

it("a tolerance is a number that is not negative; empty is none", () => {
  expect(["", " 0,5 ", "1e3", "-1", "x", "101"].map((text) => bounded(text, 100))).toEqual([
    0,
    0.5,
    null,
    null,
    null,
    null,
  ]);
});

it("the first values of a column show where a cell is empty", () => {
  expect(firstValues([["1", "TRUE"], ["2", ""], ["3"]], 1)).toBe("TRUE · – · –");
});

it("problems are listed by column; those of the whole file belong to no column", () => {
  const problem = (row: number | null, column: string) => ({
    row,
    column,
    message: "?",
    warning: false,
    more: 0,
    last: null,
    near: [],
  });
  const found = byColumn([problem(2, "speed"), problem(null, ""), problem(9, "speed")]);
  expect([...found.keys()]).toEqual(["speed"]);
  expect(found.get("speed")?.map(({ row }) => row)).toEqual([2, 9]);
});
