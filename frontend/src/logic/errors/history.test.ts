import { describe, expect, it } from "vitest";
import type { TestRecord } from "../../wire/types";
import { everything, type HistoryLine, historyLines, isFiltered, recordLines, sortedBy } from "./history";

const line = (id: string, more: Partial<HistoryLine> = {}): HistoryLine => ({
  id,
  name: `Error ${id}`,
  severity: "nonfatal",
  status: "never",
  code: "00F7",
  details: "",
  generated_at: null,
  recovered_at: null,
  generated_scan: null,
  recovered_scan: null,
  recovered_by: "",
  recovered_way: null,
  acknowledged: null,
  by: null,
  origin: null,
  count: 0,
  reaction: null,
  swept: null,
  fitted: true,
  instance: "",
  label: "",
  ...more,
});

const done = (verdict: "acted" | "never_read", scans: number | null = null): HistoryLine["reaction"] => ({
  state: "done",
  verdict,
  scans,
  unmet: 0,
  message: "",
});

const LINES = [
  line("a", { status: "cleared", by: "Mika", count: 2, reaction: done("never_read") }),
  line("b", { severity: "fatal", status: "generated", code: "80F1", details: "rack=2", reaction: done("acted", 3) }),
  line("c"),
  line("d", {
    status: "generated",
    by: "Ada",
    count: 1,
    reaction: { ...done("acted", 1), state: "recording", verdict: null } as HistoryLine["reaction"],
  }),
];
const ids = (lines: HistoryLine[]) => lines.map(({ id }) => id).join("");

describe("the history", () => {
  it("is filtered by state, severity, reaction and text", () => {
    expect(ids(historyLines(LINES, everything))).toBe("abcd");
    expect(ids(historyLines(LINES, { ...everything, status: "generated" }))).toBe("bd");
    expect(ids(historyLines(LINES, { ...everything, severity: "fatal" }))).toBe("b");
    expect(ids(historyLines(LINES, { ...everything, reaction: "findings" }))).toBe("a");
    expect(ids(historyLines(LINES, { ...everything, reaction: "acted" }))).toBe("b");
    expect(ids(historyLines(LINES, { ...everything, reaction: "unknown" }))).toBe("cd");
    expect(ids(historyLines(LINES, { ...everything, text: " MIKA" }))).toBe("a");
    expect(ids(historyLines(LINES, { ...everything, text: "rack" }))).toBe("b");
    expect(isFiltered({ ...everything, text: " " })).toBe(false);
    expect(isFiltered({ ...everything, reaction: "unknown" })).toBe(true);
  });

  it("is sorted, with rows without a value at the end", () => {
    expect(ids(historyLines(LINES, { ...everything, sort: { column: "by", down: false } }))).toBe("dabc");
    expect(ids(historyLines(LINES, { ...everything, sort: { column: "by", down: true } }))).toBe("adbc");
    expect(ids(historyLines(LINES, { ...everything, sort: { column: "reaction", down: false } }))).toBe("abcd");
    expect(ids(historyLines(LINES, { ...everything, sort: { column: "severity", down: false } }))).toBe("bacd");
    expect(ids(historyLines(LINES, { ...everything, sort: { column: "status", down: false } }))).toBe("bdac");
  });

  it("is sorted up, down and as in the catalogue, by clicks on a column", () => {
    const up = sortedBy(null, "code");
    expect(up).toEqual({ column: "code", down: false });
    expect(sortedBy(up, "code")).toEqual({ column: "code", down: true });
    expect(sortedBy({ column: "code", down: true }, "code")).toBeNull();
    expect(sortedBy(up, "by")).toEqual({ column: "by", down: false });
  });
});

describe("an imported record", () => {
  it("says where its verdicts come from", () => {
    const error = {
      ...line("a"),
      group: "",
      flag: "",
      by: "",
      verdict: "never_read",
      verdict_from: "sweep",
      scans: null,
    };
    const accepted = [{ state: "now", reason: "no battery", by: "Eva", at: "" }];
    const record = { errors: [{ ...error, reaction: null, reaction_note: "", accepted }] } as unknown as TestRecord;
    const [row] = recordLines(record);
    expect(row).toMatchObject({
      by: null,
      swept: { verdict: "never_read" },
      accepted: "no battery (Eva)",
      reaction: null,
    });
  });
});
