import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { eventually } from "../../testing/eventually";
import type { VerificationInfo, VerifyRow, VerifyRows } from "../../wire/types";
import { verify as wire } from "../../wire/verify";
import { onVerifications, resetVerify } from "./verify";
import {
  goToDifference,
  indexAt,
  lineCount,
  lineOfRow,
  seeLines,
  showOnlyDiffering,
  useVerifyRows,
} from "./verifyRows";

const info = (part: Partial<VerificationInfo>): VerificationInfo => ({
  id: 1,
  by: "Ada",
  title: "Belt",
  range: { pou: "Belt", file: "", first: 0, last: 0, instance: "" },
  source: "live",
  trace: "",
  pace: "free",
  auto: false,
  memory: "recorded",
  state: "verifying",
  message: "",
  instances: [],
  limit: 4096,
  first: 100,
  last: null,
  scan: null,
  compared: 0,
  skipped: 0,
  coverage: null,
  not_run: 0,
  not_reached: 0,
  verdict: "same",
  stretches: [],
  differing: 0,
  first_difference: null,
  first_scan: null,
  rows: 0,
  forgotten: 0,
  used: 0,
  generation: 0,
  ...part,
});

let value = "00";
let server = { first: 0, count: 0, differing: [] as number[] };

const rowAt = (index: number): VerifyRow => ({
  index,
  kind: "pass",
  scan: 100 + index,
  call: 1,
  count: 0,
  instance: "",
  place: null,
  outputs: { a: { control: value, monitor: value, set: null } },
  inputs: {},
  differences: [],
  consequences: [],
  next: null,
  disturbances: [],
  used: 1,
  note: "",
  compared: true,
});

const asked: [number, number, boolean][] = [];

beforeEach(() => {
  resetVerify();
  asked.length = 0;
  value = "00";
  useVerifyRows.setState({ of: "", onlyDiffering: false, byIndex: new Map(), differing: [], first: 0, count: 0 });
  vi.spyOn(wire, "rows").mockImplementation(async (_of, first, count, differing): Promise<VerifyRows> => {
    asked.push([first, count, differing]);
    const all = [...Array(server.count - server.first)].map((_, at) => server.first + at);
    const wanted = (differing ? server.differing : all).filter((index) => index >= first).slice(0, count);
    return { columns: [], rows: wanted.map(rowAt), ...server };
  });
});
afterEach(() => vi.restoreAllMocks());

const settled = () => eventually(() => expect(useVerifyRows.getState().count).toBe(server.count));

describe("rows of a verification", () => {
  it("at the end of the table are all there while more come than an answer has", async () => {
    const asking = vi.mocked(wire.rows).getMockImplementation() as typeof wire.rows;
    vi.mocked(wire.rows).mockImplementation(async (...wanted) => {
      await new Promise((resolve) => setTimeout(resolve)); // of a request that is under way, while the table is drawn
      server = { ...server, first: Math.max(0, server.count - 3700), count: server.count + 300 };
      return asking(...wanted);
    });
    let filled = false;
    const holes: number[] = [];
    const stop = useVerifyRows.subscribe((rows) => {
      const lines = lineCount(rows);
      const visible = [...Array(Math.min(40, lines))].map((_, at) => rows.byIndex.has(indexAt(rows, lines - 1 - at)));
      if (filled && visible.includes(false)) holes.push(rows.count);
      filled ||= lines > 0 && !visible.includes(false);
      setTimeout(() => seeLines(Math.max(0, lines - 40), lines, true));
    });
    server = { first: 0, count: 11_000, differing: [] };
    for (let told = 1; told <= 20; told += 1) {
      const { count } = server;
      onVerifications([info({ rows: count, forgotten: server.first })]);
      await eventually(() => expect(useVerifyRows.getState().count).toBeGreaterThanOrEqual(count));
    }
    stop();
    expect([filled, holes]).toEqual([true, []]);
  });

  it("are fetched for the visible lines although earlier differences were dropped", async () => {
    server = { first: 600, count: 1000, differing: [] };
    onVerifications([info({ rows: 1000, forgotten: 600, differing: 3 })]);
    seeLines(0, 30);
    await settled();
    seeLines(300, 330);
    await eventually(() => expect(useVerifyRows.getState().byIndex.has(929)).toBe(true));
  });

  it("are fetched for the visible lines, and after scrolling", async () => {
    server = { first: 0, count: 1000, differing: [400] };
    onVerifications([info({ rows: 1000, differing: 1 })]);
    seeLines(0, 30);
    await settled();
    expect(useVerifyRows.getState().byIndex.has(29)).toBe(true);
    seeLines(500, 530);
    await eventually(() => expect(useVerifyRows.getState().byIndex.has(529)).toBe(true));
    expect(useVerifyRows.getState().byIndex.has(300)).toBe(false);
  });

  it("are not fetched if nothing visible is new: then only the counts are requested", async () => {
    server = { first: 0, count: 200, differing: [] };
    onVerifications([info({ rows: 200 })]);
    seeLines(0, 30);
    await settled();
    const before = asked.length;
    server = { first: 0, count: 260, differing: [] };
    onVerifications([info({ rows: 260 })]);
    await settled();
    expect(asked.slice(before).map(([, count]) => count)).toEqual([0]);
  });

  it("of a new generation are fetched again", async () => {
    server = { first: 0, count: 50, differing: [] };
    onVerifications([info({ rows: 50 })]);
    seeLines(0, 30);
    await settled();
    value = "01";
    onVerifications([info({ rows: 50, generation: 1 })]);
    await eventually(() => expect(useVerifyRows.getState().byIndex.get(5)?.outputs.a?.control).toBe("01"));
  });

  it("are dropped when the server drops them, and lines count from the first one that is kept", async () => {
    server = { first: 0, count: 50, differing: [] };
    onVerifications([info({ rows: 50 })]);
    seeLines(0, 30);
    await settled();
    server = { first: 20, count: 70, differing: [] };
    onVerifications([info({ rows: 70, forgotten: 20 })]);
    await settled();
    const rows = useVerifyRows.getState();
    expect(rows.byIndex.has(5)).toBe(false);
    expect([lineCount(rows), indexAt(rows, 0), lineOfRow(rows, 20), lineOfRow(rows, 5)]).toEqual([50, 20, 0, -1]);
  });

  it("can be filtered to those that differ, with a step from each to the next", async () => {
    server = { first: 0, count: 900, differing: [40, 700] };
    onVerifications([info({ rows: 900, differing: 2 })]);
    seeLines(0, 30);
    await settled();
    showOnlyDiffering(true);
    await eventually(() => expect(useVerifyRows.getState().byIndex.has(700)).toBe(true));
    const rows = useVerifyRows.getState();
    expect([lineCount(rows), indexAt(rows, 1), lineOfRow(rows, 700)]).toEqual([2, 700, 1]);
    expect([goToDifference("first"), goToDifference("next"), goToDifference("next")]).toEqual([40, 700, null]);
    expect(useVerifyRows.getState().selected).toBe(700);
    expect(goToDifference("previous")).toBe(40);
  });
});
