import { describe, expect, it } from "vitest";
import { setLanguage } from "../../text";
import type { VerifyColumn, VerifyRow } from "../../wire/types";
import {
  differsIn,
  firstDifferingUnit,
  isEdited,
  isWholeScan,
  memberOf,
  nextDifferent,
  resultOf,
  scanTyped,
  stretchLines,
  titleOf,
  variableOf,
  writtenBefore,
} from "./verify";

const column: VerifyColumn = {
  name: "speed",
  type: "INT",
  kind: "int",
  size: 2,
  values: [],
  output: true,
  input: true,
};
const output = { key: "output:speed", side: "output" as const, column };
const input = { key: "input:speed", side: "input" as const, column };

const row = (part: Partial<VerifyRow>): VerifyRow => ({
  index: 0,
  kind: "pass",
  scan: 1,
  call: 1,
  count: 0,
  instance: "",
  place: null,
  outputs: {},
  inputs: {},
  differences: [],
  consequences: [],
  next: null,
  disturbances: [],
  used: 1,
  note: "",
  compared: true,
  ...part,
});

describe("rows", () => {
  it("A' is the result on the chosen memory of the monitor; a row without edits has one result", () => {
    const edited = { control: "1802", monitor: "5802", set: "1802" };
    expect(resultOf(edited, "recorded")).toBe("5802");
    expect(resultOf(edited, "set")).toBe("1802");
    expect(resultOf({ ...edited, set: null }, "set")).toBe("5802");
  });

  it("an output differs when its two results do, also when one side did not write it", () => {
    const one = row({ outputs: { speed: { control: "1802", monitor: "5802", set: "1802" } } });
    expect(differsIn(one, output, "recorded")).toBe(true);
    expect(differsIn(one, output, "set")).toBe(false);
    const unwritten = row({ outputs: { speed: { control: null, monitor: "5802", set: null } } });
    expect(differsIn(unwritten, output, "recorded")).toBe(true);
    expect(differsIn(row({}), output, "recorded")).toBe(false);
  });

  it("an input differs when the monitor would have read a different value", () => {
    const disturbed = row({ inputs: { speed: { recorded: "4000", expected: "0000", set: null } } });
    expect(differsIn(disturbed, input, "recorded")).toBe(true);
    expect(isEdited(disturbed)).toBe(false);
    expect(isEdited(row({ inputs: { speed: { recorded: "4000", expected: null, set: "0100" } } }))).toBe(true);
  });
});

describe("going from difference to difference", () => {
  const differing = [3, 17, 40];
  it("finds the next and the previous one, from any row", () => {
    expect(nextDifferent(differing, null, 1)).toBe(3);
    expect(nextDifferent(differing, 3, 1)).toBe(17);
    expect(nextDifferent(differing, 20, 1)).toBe(40);
    expect(nextDifferent(differing, 20, -1)).toBe(17);
    expect(nextDifferent(differing, null, -1)).toBe(40);
  });

  it("stops at both ends", () => {
    expect(nextDifferent(differing, 40, 1)).toBeNull();
    expect(nextDifferent(differing, 3, -1)).toBeNull();
    expect(nextDifferent([], null, 1)).toBeNull();
  });
});

describe("entries and labels", () => {
  it("a scan may have spaces between its digits", () => {
    expect(scanTyped(" 128 388 ")).toBe(128388);
    expect(scanTyped("128\u2009388")).toBe(128388);
    expect(scanTyped("1,200")).toBe(1200);
    for (const bad of ["", "12a", "-3", "now"]) expect(scanTyped(bad)).toBeNull();
  });

  it("ranges of skipped scans say how many they are", () => {
    expect(
      stretchLines([
        [7, 7],
        [10, 14],
      ]),
    ).toEqual(["7", "10 – 14 (5)"]);
  });

  it("without POU and file it is the whole scan", () => {
    expect(isWholeScan({})).toBe(true);
    expect(isWholeScan({ pou: "", file: "" })).toBe(true);
    expect(isWholeScan({ pou: "Belt" })).toBe(false);
  });
});

describe("variables of a row", () => {
  const differs = (part: Partial<VerifyRow["differences"][number]>): VerifyRow["differences"][number] => ({
    cause: "logic",
    name: "speed",
    control: "01",
    monitor: "02",
    place: null,
    message: "",
    type: "INT",
    kind: "int",
    size: 2,
    ...part,
  });

  it("is the variable of the difference, else that of the selected column", () => {
    expect(variableOf(differs({ name: "D120" }), null)).toBe("D120");
    expect(variableOf(null, "input:zone.parts")).toBe("zone.parts");
    expect(variableOf(null, "output:a[1,2]:A'")).toBe("a[1,2]");
    expect(variableOf(differs({ name: "count (global)" }), null)).toBe("count");
  });

  it("does not exist for a difference without a variable", () => {
    expect(variableOf(null, "scan")).toBeNull();
    expect(variableOf(differs({ cause: "order", name: "next statement" }), null)).toBeNull();
    expect(variableOf(differs({ cause: "trap", name: "run-time error" }), null)).toBeNull();
  });

  it("has a path: a variable of the block is below its instance, any other name is a path already", () => {
    const inside = [{ path: "Main.belt.position" }, { path: "Main.belt.zone" }];
    expect(memberOf("Main.belt", inside, "position")).toBe("Main.belt.position");
    expect(memberOf("Main.belt", inside, "Zone.parts[3]")).toBe("Main.belt.Zone.parts[3]");
    expect(memberOf("Main.belt", inside, "positions")).toBe("positions");
    expect(memberOf("Main", [{ path: "Main.count" }], "Main.count")).toBe("Main.count");
    expect(memberOf("", [], "lamp")).toBe("lamp");
  });

  it("was written before the scan if it is an input, in the scan if it is a result", () => {
    expect(writtenBefore(row({ scan: 9 }), differs({ cause: "input" }))).toBe(9);
    expect(writtenBefore(row({ scan: 9 }), differs({}))).toBe(10);
    expect(writtenBefore(row({ scan: 9 }), null)).toBe(10);
  });

  it("gets the selection when it differs", () => {
    const both = { control: "01", monitor: "01", set: null };
    const read = row({ outputs: { speed: both }, differences: [differs({ cause: "input" })] });
    expect(firstDifferingUnit(read, [output, input], "recorded")).toBe(input);
    const written = row({ outputs: { speed: { ...both, monitor: "02" } }, differences: [differs({})] });
    expect(firstDifferingUnit(written, [input, output], "recorded")).toBe(output);
  });
});

it("is described in the language of the page", () => {
  const said = () =>
    ["the whole scan", "Belt, lines 14 to 20", "Belt.run, line 3", "Belt"].map((title) => titleOf({ title }));
  expect(said()).toEqual(["the whole scan", "Belt, lines 14 to 20", "Belt.run, line 3", "Belt"]);
  setLanguage("ja");
  expect(said()).toEqual(["スキャン全体", "Belt、14～20 行", "Belt.run、3 行目", "Belt"]);
  setLanguage("en");
});
