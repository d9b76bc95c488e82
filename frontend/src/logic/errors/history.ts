/** The error history as a table, filtered and sorted: of this PLC, of an earlier program version, or of an imported record. */
import type { ErrorHistoryRow, TestRecord, Verdict } from "../../wire/types";
import { idOf } from "../plc/errorInstances";
import { isFinding, type ReactionFilter, reactionOf, verdictOf } from "./catalogue";

/** A row, from any of these sources. */
export interface HistoryLine extends ErrorHistoryRow {
  /** Why the finding was accepted, and by whom; empty: it was not accepted. */
  accepted?: string;
}

export type Column =
  | "error"
  | "severity"
  | "status"
  | "generated"
  | "recovered"
  | "code"
  | "by"
  | "count"
  | "reaction"
  | "scans";

export interface HistoryView {
  text: string;
  status: ErrorHistoryRow["status"] | "all";
  severity: ErrorHistoryRow["severity"] | "all";
  reaction: ReactionFilter;
  /** Null is the order of the catalogue. */
  sort: { column: Column; down: boolean } | null;
}

export const everything: HistoryView = { text: "", status: "all", severity: "all", reaction: "all", sort: null };

export function isFiltered({ text, status, severity, reaction }: HistoryView): boolean {
  return text.trim() !== "" || status !== "all" || severity !== "all" || reaction !== "all";
}

/** The rows to show, in the chosen order. */
export function historyLines(lines: readonly HistoryLine[], view: HistoryView): HistoryLine[] {
  const shown = lines.filter((line) => passes(line, view));
  const { sort } = view;
  if (!sort) return shown;
  const sign = sort.down ? -1 : 1;
  // Rows without a value come last, in both sort directions.
  return shown.sort((a, b) => {
    const [one, other] = [keyOf(a, sort.column), keyOf(b, sort.column)];
    if (one === null || other === null) return Number(one === null) - Number(other === null);
    return sign * (one < other ? -1 : one > other ? 1 : 0);
  });
}

function passes(line: HistoryLine, view: HistoryView): boolean {
  if (view.status !== "all" && line.status !== view.status) return false;
  if (view.severity !== "all" && line.severity !== view.severity) return false;
  const verdict = verdictOf(line);
  if (view.reaction === "findings" && !isFinding(verdict)) return false;
  if (view.reaction === "unknown" && verdict !== null) return false;
  if (!["all", "findings", "unknown"].includes(view.reaction) && verdict !== view.reaction) return false;
  const wanted = view.text.trim().toLowerCase();
  return [line.name, line.id, line.code, line.details, line.by ?? ""].some((text) =>
    text.toLowerCase().includes(wanted),
  );
}

const STATUS = { generated: 0, cleared: 1, never: 2 };
const SEVERITY = { fatal: 0, nonfatal: 1 };
/** The worst first; those of before there were grades come beside what they may be. */
const VERDICT: Record<Verdict, number> = {
  never_read: 0,
  not_reached: 1,
  no_effect: 2,
  stored: 3,
  stored_only: 4,
  displayed: 5,
  stopped: 6,
  decided: 7,
  reacted: 8,
  acted: 9,
};

function keyOf(line: HistoryLine, column: Column): string | number | null {
  const verdict = verdictOf(line);
  switch (column) {
    case "error":
      return line.name.toLowerCase();
    case "severity":
      return SEVERITY[line.severity];
    case "status":
      return STATUS[line.status];
    case "generated":
      return line.generated_at;
    case "recovered":
      return line.recovered_at;
    case "code":
      return line.code;
    case "by":
      return line.by?.toLowerCase() ?? null;
    case "count":
      return line.count || null;
    case "reaction":
      return verdict === null ? null : VERDICT[verdict];
    case "scans":
      return reactionOf(line)?.scans ?? null;
  }
}

/** Clicks on the head of a column sort by it, then in the other direction, then as in the catalogue. */
export function sortedBy(sort: HistoryView["sort"], column: Column): HistoryView["sort"] {
  if (sort?.column !== column) return { column, down: false };
  return sort.down ? null : { column, down: true };
}

/** An imported record's errors as rows. */
export function recordLines(record: TestRecord): HistoryLine[] {
  return record.errors.map((error) => ({
    ...error,
    id: idOf(error.id),
    instance: error.id,
    fitted: true,
    label: "",
    recovered_by: "",
    recovered_way: null,
    acknowledged: null,
    by: error.by || null,
    ...(error.verdict_from === "sweep"
      ? { reaction: null, swept: reactionIn(error) }
      : { reaction: reactionIn(error), swept: null }),
    accepted: error.accepted.map(({ reason, by }) => `${reason} (${by})`).join("; "),
  }));
}

function reactionIn(error: TestRecord["errors"][number]): ErrorHistoryRow["reaction"] {
  const message = error.reaction_note || error.reaction?.note || "";
  const { verdict, scans, unmet } = error;
  if (verdict !== null) return { state: "done", verdict, scans, unmet, message };
  return message ? { state: "failed", verdict: null, scans: null, unmet: 0, message } : null;
}
