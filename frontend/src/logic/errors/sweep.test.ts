import { describe, expect, it } from "vitest";
import type { Sweep, SweepCell, SweepChange, SweepSummary, Verdict } from "../../wire/types";
import {
  countCells,
  firstFinding,
  isOpen,
  type MatrixRow,
  matrixRows,
  merged,
  olderFirst,
  secondsLeft,
  sortedChanges,
  stepIn,
  withAccepted,
} from "./sweep";

const ALL = { findings: false, verdict: null };

function cell(error: string, state: string, verdict: Verdict | null, more: Partial<SweepCell> = {}): SweepCell {
  return {
    error,
    state,
    verdict,
    first_read: null,
    first_effect: null,
    raised_scan: 7,
    difference_count: 0,
    required: 0,
    unmet: 0,
    note: "",
    accepted: null,
    ...more,
  };
}

function sweep(cells: SweepCell[], more: Partial<Sweep> = {}): Sweep {
  const error = (id: string, group: string, severity: "fatal" | "nonfatal") => ({
    id,
    name: id.toUpperCase(),
    code: "0001",
    severity,
    group,
  });
  return {
    id: 1,
    project: 1,
    instance_id: 1,
    instance: "line-1",
    model: "CJ1M-CPU63",
    program_version: 3,
    by: "Ann",
    at: "2026-11-21T14:20:00+00:00",
    status: "done",
    message: "",
    done: cells.length,
    total: 6,
    window: 200,
    states: ["Idle", "Running"],
    counts: {},
    unmet: 0,
    problems: [],
    seconds: 2,
    errors: [
      error("memory", "Fatal", "fatal"),
      error("battery", "Non-fatal", "nonfatal"),
      error("setup", "Non-fatal", "nonfatal"),
    ],
    cells,
    ...more,
  };
}

const errorsIn = (rows: readonly MatrixRow[]) => rows.flatMap((row) => (row.kind === "error" ? [row.error.id] : []));
const rowOf = (rows: readonly MatrixRow[], id: string) => {
  const row = rows.find((known) => known.kind === "error" && known.error.id === id);
  if (row?.kind !== "error") throw new Error(`no row ${id}`);
  return row;
};

describe("matrixRows", () => {
  const full = sweep([
    cell("memory", "Idle", "stopped"),
    cell("memory", "Running", "stopped"),
    cell("battery", "Idle", "never_read"),
    cell("battery", "Running", "acted", { first_read: 1, first_effect: 2 }),
    cell("setup", "Idle", null, { note: "Not on this model" }),
    cell("setup", "Running", null, { note: "Not on this model" }),
  ]);

  it("puts a group's name above its errors", () => {
    expect(matrixRows(full, ALL).map((row) => (row.kind === "group" ? row.name : row.error.id))).toEqual([
      "Fatal",
      "memory",
      "Non-fatal",
      "battery",
      "setup",
    ]);
  });

  it("shows a result once when it is the same in all states", () => {
    const rows = matrixRows(full, ALL);
    expect(rowOf(rows, "memory").line).toEqual({ what: "stopped" });
    expect(rowOf(rows, "setup").line).toEqual({ what: "note", note: "Not on this model", unmet: false });
    expect(rowOf(rows, "battery").line).toBeNull();
  });

  it("shows cells separately when they could not be raised for different reasons", () => {
    const rows = matrixRows(
      sweep([cell("setup", "Idle", null, { note: "a" }), cell("setup", "Running", null, { note: "b" })]),
      ALL,
    );
    expect(rowOf(rows, "setup").line).toBeNull();
  });

  it("distinguishes the cell that runs now from those that wait", () => {
    const rows = matrixRows(
      sweep(
        [
          cell("memory", "Idle", "stopped"),
          cell("memory", "Running", "stopped"),
          cell("battery", "Idle", "never_read"),
        ],
        { status: "running" },
      ),
      ALL,
    );
    expect(rowOf(rows, "battery").slots[1]).toBe("running");
    expect(rowOf(rows, "setup").slots).toEqual(["waiting", "waiting"]);
    expect(rowOf(rows, "setup").line).toEqual({ what: "waiting" });
  });

  it("shows no waiting cells after a sweep was cancelled", () => {
    const rows = matrixRows(sweep([cell("memory", "Idle", "stopped")], { status: "cancelled" }), ALL);
    expect(rowOf(rows, "memory").slots[1]).toBe("missing");
    expect(rowOf(rows, "setup").line).toEqual({ what: "missing" });
  });

  it("omits rows without an open finding, and the groups that become empty", () => {
    const rows = matrixRows(full, { findings: true, verdict: null });
    expect(rows.map((row) => row.kind)).toEqual(["group", "error"]);
    expect(errorsIn(rows)).toEqual(["battery"]);
    const accepted = withAccepted(full, { error: "battery", state: "Idle" }, { reason: "spare", by: "Ann", at: "" });
    expect(matrixRows(accepted, { findings: true, verdict: null })).toEqual([]);
    expect(errorsIn(matrixRows(accepted, { findings: false, verdict: "accepted" }))).toEqual(["battery"]);
  });

  it("shows the rows with one verdict", () => {
    expect(errorsIn(matrixRows(full, { findings: false, verdict: "acted" }))).toEqual(["battery"]);
    expect(errorsIn(matrixRows(full, { findings: false, verdict: "none" }))).toEqual(["setup"]);
  });

  it("starts the search at the first finding that nobody accepted", () => {
    expect(firstFinding(matrixRows(full, ALL))).toEqual({ error: "battery", state: "Idle" });
    expect(firstFinding(matrixRows(sweep([]), ALL))).toBeNull();
  });
});

describe("countCells", () => {
  it("counts what is not as required by itself, and not as acted", () => {
    const found = sweep([
      cell("memory", "Idle", "acted", { required: 1, unmet: 1 }),
      cell("battery", "Idle", "acted", { required: 1 }),
    ]);
    expect(countCells(found)).toMatchObject({ verdicts: { acted: 1 }, unmet: 1 });
    const shown = (verdict: "acted" | "unmet") =>
      matrixRows(found, { findings: false, verdict }).flatMap((row) => (row.kind === "error" ? [row.error.id] : []));
    expect([shown("acted"), shown("unmet")]).toEqual([["battery"], ["memory"]]);
  });

  it("counts an accepted finding only as accepted", () => {
    const found = sweep([
      cell("memory", "Idle", "stopped"),
      cell("battery", "Idle", "never_read", { accepted: { reason: "r", by: "Ann", at: "" } }),
      cell("battery", "Running", "no_effect"),
      cell("setup", "Idle", null),
    ]);
    expect(countCells(found)).toEqual({
      verdicts: {
        acted: 0,
        decided: 0,
        stopped: 1,
        displayed: 0,
        stored: 0,
        no_effect: 1,
        not_reached: 0,
        never_read: 0,
        reacted: 0,
        stored_only: 0,
      },
      accepted: 1,
      unmet: 0,
      none: 1,
      left: 2,
    });
  });
});

describe("stepIn", () => {
  const rows = matrixRows(sweep([]), ALL);
  const step = (row: number, column: number, key: string) => stepIn(rows, 2, { row, column }, key, 10);

  it("skips the names of groups", () => {
    expect(step(1, 1, "ArrowDown")).toEqual({ row: 3, column: 1 });
    expect(step(3, 1, "ArrowUp")).toEqual({ row: 1, column: 1 });
  });

  it("stays inside the matrix", () => {
    expect(step(1, 0, "ArrowUp")).toEqual({ row: 1, column: 0 });
    expect(step(1, 0, "ArrowLeft")).toEqual({ row: 1, column: 0 });
    expect(step(4, 1, "ArrowRight")).toEqual({ row: 4, column: 1 });
    expect(step(1, 0, "PageDown")).toEqual({ row: 4, column: 0 });
  });

  it("goes to the ends of a row and of the matrix", () => {
    expect(step(3, 0, "End")).toEqual({ row: 3, column: 1 });
    expect(step(3, 1, "Home")).toEqual({ row: 3, column: 0 });
    expect(step(1, 0, "Ctrl+End")).toEqual({ row: 4, column: 1 });
    expect(step(4, 1, "Ctrl+Home")).toEqual({ row: 1, column: 0 });
  });

  it("begins at the first error, and ignores other keys", () => {
    expect(stepIn(rows, 2, null, "ArrowDown", 10)).toEqual({ row: 1, column: 0 });
    expect(stepIn(rows, 2, null, "x", 10)).toBeNull();
    expect(step(1, 0, "x")).toBeNull();
    expect(stepIn([], 2, null, "ArrowDown", 10)).toBeNull();
  });
});

describe("merged", () => {
  const told = (more: Partial<SweepSummary>): SweepSummary => {
    const { errors: _errors, cells: _cells, ...summary } = sweep([]);
    return { ...summary, ...more };
  };

  it("replaces cells that have a new result, and keeps the others as they are", () => {
    const before = sweep([cell("memory", "Idle", "stopped"), cell("battery", "Idle", "never_read")]);
    const after = merged(before, told({ done: 3 }), [
      cell("battery", "Idle", "acted"),
      cell("setup", "Idle", "no_effect"),
    ]);
    expect(after.done).toBe(3);
    expect(after.cells.map(({ error, verdict }) => `${error} ${verdict}`)).toEqual([
      "memory stopped",
      "battery acted",
      "setup no_effect",
    ]);
    expect(after.cells[0]).toBe(before.cells[0]);
  });

  it("keeps errors and cells when the summary is a whole, older sweep", () => {
    const before = sweep([cell("memory", "Idle", "stopped"), cell("battery", "Idle", "never_read")]);
    const after = merged(before, sweep([], { done: 5, errors: [] }), []);
    expect(after.done).toBe(5);
    expect(after.errors).toBe(before.errors);
    expect(after.cells).toBe(before.cells);
  });
});

describe("secondsLeft", () => {
  it("is estimated from the time that the results took so far", () => {
    expect(secondsLeft(sweep([], { status: "running", done: 90, total: 120, seconds: 9 }))).toBeCloseTo(3);
  });

  it("is unknown before the first result, and after the end", () => {
    expect(secondsLeft(sweep([], { status: "running", done: 0, seconds: 9 }))).toBeNull();
    expect(secondsLeft(sweep([], { status: "done", done: 6 }))).toBeNull();
  });
});

describe("comparing", () => {
  it('takes the older sweep as "before"', () => {
    const list = [sweep([], { id: 5, at: "2026-11-21T15:00" }), sweep([], { id: 3, at: "2026-11-21T14:00" })];
    expect(olderFirst(list, 5, 3)).toEqual([3, 5]);
    expect(olderFirst(list, 3, 5)).toEqual([3, 5]);
  });

  it("lists what became worse first, and unchanged cells only on demand", () => {
    const change = (error: string, kind: SweepChange["change"]): SweepChange => ({
      error,
      name: error,
      state: "Idle",
      before: null,
      after: null,
      scans_before: null,
      scans_after: null,
      change: kind,
    });
    const all = [change("a", "same"), change("b", "better"), change("c", "worse"), change("d", "better")];
    expect(sortedChanges(all, true).map(({ error }) => error)).toEqual(["c", "b", "d"]);
    expect(sortedChanges(all, false).map(({ error }) => error)).toEqual(["c", "b", "d", "a"]);
  });
});

it("what is not as the project requires it is open, whatever the verdict, and nobody can accept it", () => {
  const accepted = { reason: "later", by: "Ada", at: "2026-11-20T10:00:00Z" };
  expect(isOpen(cell("e", "s", "acted", { required: 2, unmet: 1 }))).toBe(true);
  expect(isOpen(cell("e", "s", "acted", { required: 2 }))).toBe(false);
  expect(isOpen(cell("e", "s", "never_read", { unmet: 1, accepted }))).toBe(true);
});
