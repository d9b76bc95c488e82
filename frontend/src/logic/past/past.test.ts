import { describe, expect, it } from "vitest";
import type { Comparison, Instance, VariableChange } from "../../wire/types";
import {
  changesAsText,
  compareWith,
  errorsIn,
  filterChanges,
  leftOut,
  ordered,
  shareOf,
  verdictOf,
  withNewest,
} from "./past";

const change = (path: string, before: string, after: string): VariableChange => ({
  path,
  type: "INT",
  kind: "signed",
  size: 2,
  values: [],
  before: "0000",
  after: "0100",
  before_shown: before,
  after_shown: after,
});

const CHANGES = [change("Main.belt[1].speed", "0", "25"), change("Main.count", "7", "8")];

describe("changes", () => {
  it("are filtered by every word: in path, type and values", () => {
    expect(filterChanges(CHANGES, "belt 25").map(({ path }) => path)).toEqual(["Main.belt[1].speed"]);
    expect(filterChanges(CHANGES, "int")).toHaveLength(2);
    expect(filterChanges(CHANGES, "belt 8")).toEqual([]);
    expect(filterChanges(CHANGES, "  ")).toHaveLength(2);
  });

  it("are copied as a table that keeps its columns", () => {
    const text = changesAsText([change("Main.s", "'a\tb'", "'c'")], ["Scan 1", "Scan 2"]);
    expect(text.split("\n").map((line) => line.split("\t").length)).toEqual([4, 4]);
    expect(text).toContain("Scan 1\tScan 2");
  });

  it("say how many are not listed", () => {
    const changes = { first: 1, last: 2, changes: CHANGES, count: 9, entries: [], note: "", at_least: false };
    expect(leftOut(changes)).toBe(7);
  });

  it("accept the two scans in either order", () => {
    expect(ordered(9, 4)).toEqual({ from: 4, to: 9 });
    expect(ordered(null, 4)).toBeNull();
  });
});

describe("comparisons", () => {
  const instance = (id: number, name: string, project = 1) => ({ id, name, project: { id: project } }) as Instance;

  it("offer the branches of this run first, then other PLCs of the project, then the rest", () => {
    const here = instance(1, "line-1");
    const all = [here, instance(2, "press", 2), instance(3, "mixer"), instance(4, "line-2"), instance(5, "line-3")];
    expect(compareWith(here, all).map(({ id }) => id)).toEqual([5, 4, 3, 2]);
    const elsewhere = { ...instance(6, "line-4"), project: { ...here.project, id: 3, model: "NJ501" } };
    expect(compareWith(here, [here, elsewhere])).toEqual([]);
  });

  it("say what they found", () => {
    const going: Comparison = {
      type: "comparison",
      id: 1,
      a: 1,
      b: 2,
      by: "A",
      done: 5,
      of: 10,
      result: null,
      message: "",
    };
    const result = {
      compared: 9,
      first: 0,
      last: 9,
      scan: null,
      cause: "" as const,
      text: "",
      place: null,
      changes: null,
      entries: [],
      marks: [],
      same: "all" as const,
      variables: null,
      left: [],
      left_count: 0,
    };
    expect(verdictOf({ ...going, result: { ...result, same: "partly" } })).toBe("partly");
    expect(verdictOf({ ...going, result: { ...result, same: "nothing" } })).toBe("nothing");
    expect(verdictOf(going)).toBe("underway");
    expect(verdictOf({ ...going, message: "gone" })).toBe("failed");
    expect(verdictOf({ ...going, result })).toBe("same");
    expect(verdictOf({ ...going, result: { ...result, scan: 4 } })).toBe("apart");
    expect(shareOf(going)).toBe(0.5);
    expect(shareOf({ done: 0, of: 0 })).toBe(0);
  });

  it("keep the newest state of each", () => {
    const known = [
      { id: 3, done: 1 },
      { id: 1, done: 1 },
    ];
    expect(withNewest(known, { id: 1, done: 2 })).toEqual([
      { id: 3, done: 1 },
      { id: 1, done: 2 },
    ]);
    expect(withNewest(known, { id: 4, done: 0 })[0]?.id).toBe(4);
  });
});

describe("the errors of marks", () => {
  it("are found by their ids", () => {
    const ids = new Set(["battery-error", "io-bus"]);
    expect(errorsIn("generate battery-error (rack=2), io-bus, battery-error", ids)).toEqual([
      "battery-error",
      "io-bus",
    ]);
    expect(errorsIn("write battery", ids)).toEqual([]);
  });
});
