/** An error sweep as a matrix: rows by the catalogue's groups, what stands in each cell, what is worth a look. */
import type {
  Accepted,
  CellRef,
  ErrorGroup,
  Reaction,
  Sweep,
  SweepCell,
  SweepChange,
  SweepError,
  SweepSummary,
  Verdict,
} from "../wire/types";
import { isFinding } from "./catalogue";
import { duration } from "./numbers";
import { t } from "./text";

export const VERDICTS = ["reacted", "stopped", "no_effect", "never_read"] as const satisfies readonly Verdict[];

/** What a sweep calls the PLC as it was when it began. */
export const NOW = "Now";

/** A state by its name; that one in the language of the page. */
export const stateWord = (state: string): string => (state === NOW ? t("sweep.state.now") : state);

/** What stands where no result is (yet): it is tried now, its turn comes, or the sweep ended before it. */
type Pending = "running" | "waiting" | "missing";
export type Slot = SweepCell | Pending;

/** What all cells of a row have in common, so that it is said once. */
export type Line = { what: "stopped" } | { what: "note"; note: string } | { what: Exclude<Pending, "running"> };

export interface ErrorRow {
  kind: "error";
  error: SweepError;
  /** In the order of the sweep's states. */
  slots: readonly Slot[];
  line: Line | null;
}

export interface GroupRow {
  kind: "group";
  name: string;
}

export type MatrixRow = ErrorRow | GroupRow;

/** Which rows are shown: all, those with a finding that nobody accepted, or those with a verdict (null: not raised). */
export interface MatrixView {
  findings: boolean;
  verdict: Verdict | "accepted" | "none" | null;
}

const keyOf = ({ error, state }: CellRef) => `${error}\n${state}`;

export const isCell = (slot: Slot | undefined): slot is SweepCell => typeof slot === "object";

/** A finding that nobody accepted. */
export function isOpen(cell: SweepCell): boolean {
  return isFinding(cell.verdict) && !cell.accepted;
}

/** The rows of the matrix. Groups come in the order of their first error; one that the view leaves empty is left out. */
export function matrixRows(sweep: Sweep, view: MatrixView): MatrixRow[] {
  const cells = new Map(sweep.cells.map((cell) => [keyOf(cell), cell]));
  let current = sweep.status === "running";
  const groups = new Map<string, ErrorRow[]>();
  for (const error of sweep.errors) {
    const slots = sweep.states.map((state): Slot => {
      const cell = cells.get(keyOf({ error: error.id, state }));
      if (cell) return cell;
      // Errors are tried in their order, each from all states: the first one without a result is tried now.
      const pending = current ? "running" : sweep.status === "running" ? "waiting" : "missing";
      current = false;
      return pending;
    });
    if (!passes(slots, view)) continue;
    const rows = groups.get(error.group) ?? [];
    rows.push({ kind: "error", error, slots, line: lineOf(slots) });
    groups.set(error.group, rows);
  }
  return [...groups].flatMap(([name, rows]): MatrixRow[] => (name === "" ? rows : [{ kind: "group", name }, ...rows]));
}

/** The sweep with the names of errors and groups as this catalogue has them. */
export function inWordsOf(sweep: Sweep, catalogue: readonly ErrorGroup[]): Sweep {
  const words = new Map<string, { name: string; group: string }>();
  const collect = (groups: readonly ErrorGroup[], above: string) => {
    for (const { name, groups: inner, errors } of groups) {
      const path = above === "" ? name : `${above} / ${name}`;
      for (const error of errors) words.set(error.id, { name: error.name, group: path });
      collect(inner, path);
    }
  };
  collect(catalogue, "");
  return { ...sweep, errors: sweep.errors.map((error) => ({ ...error, ...words.get(error.id) })) };
}

function passes(slots: readonly Slot[], { findings, verdict }: MatrixView): boolean {
  const found = slots.filter(isCell);
  if (findings && !found.some(isOpen)) return false;
  if (verdict === null) return true;
  if (verdict === "accepted") return found.some((cell) => isFinding(cell.verdict) && cell.accepted);
  return found.some((cell) => cell.verdict === (verdict === "none" ? null : verdict));
}

function lineOf(slots: readonly Slot[]): Line | null {
  const [first] = slots;
  if (first === undefined || first === "running") return null;
  if (!isCell(first)) return slots.every((slot) => slot === first) ? { what: first } : null;
  const same = slots.every((slot) => isCell(slot) && slot.verdict === first.verdict && slot.note === first.note);
  if (!same) return null;
  if (first.verdict === "stopped") return { what: "stopped" };
  return first.verdict === null ? { what: "note", note: first.note } : null;
}

export interface Counts {
  verdicts: Record<Verdict, number>;
  accepted: number;
  /** Could not be raised. */
  none: number;
  /** Without a result. */
  left: number;
}

/** How many cells there are of each kind; an accepted finding counts as accepted, and not as what was found. */
export function countCells(sweep: Sweep): Counts {
  const verdicts: Record<Verdict, number> = { reacted: 0, stopped: 0, no_effect: 0, never_read: 0 };
  let accepted = 0;
  let none = 0;
  for (const cell of sweep.cells) {
    if (cell.verdict === null) none += 1;
    else if (isFinding(cell.verdict) && cell.accepted) accepted += 1;
    else verdicts[cell.verdict] += 1;
  }
  return { verdicts, accepted, none, left: Math.max(0, sweep.total - sweep.cells.length) };
}

/** The first finding that nobody accepted: where one begins to look. */
export function firstFinding(rows: readonly MatrixRow[]): CellRef | null {
  for (const row of rows) {
    const found = row.kind === "error" ? row.slots.find((slot) => isCell(slot) && isOpen(slot)) : undefined;
    if (isCell(found)) return { error: found.error, state: found.state };
  }
  return null;
}

/** A cell of the matrix by its place: index among the rows, and among the states. */
export interface Place {
  row: number;
  column: number;
}

/** Where a key leads from a cell: group rows are passed over, and a row that is one line has one place. Null: nowhere. */
export function stepIn(
  rows: readonly MatrixRow[],
  states: number,
  from: Place | null,
  key: string,
  page: number,
): Place | null {
  const errors = rows.flatMap((row, index) => (row.kind === "error" ? [index] : []));
  const [first] = errors;
  const last = errors.at(-1);
  if (first === undefined || last === undefined) return null;
  if (from === null) return MOVES.has(key) ? { row: first, column: 0 } : null;
  const at = errors.indexOf(from.row);
  const down = (by: number) => ({
    row: errors[Math.max(0, Math.min(errors.length - 1, at + by))] ?? first,
    column: from.column,
  });
  switch (key) {
    case "ArrowDown":
      return down(1);
    case "ArrowUp":
      return down(-1);
    case "PageDown":
      return down(page);
    case "PageUp":
      return down(-page);
    case "ArrowRight":
      return { row: from.row, column: Math.min(states - 1, from.column + 1) };
    case "ArrowLeft":
      return { row: from.row, column: Math.max(0, from.column - 1) };
    case "Home":
      return { row: from.row, column: 0 };
    case "End":
      return { row: from.row, column: states - 1 };
    case "Ctrl+Home":
      return { row: first, column: 0 };
    case "Ctrl+End":
      return { row: last, column: states - 1 };
    default:
      return null;
  }
}

const MOVES = new Set(["ArrowDown", "ArrowUp", "ArrowLeft", "ArrowRight", "Home", "End", "PageDown", "PageUp"]);

/** Seconds until a sweep is done, from what it took so far; null while that says too little. */
export function secondsLeft({ status, done, total, seconds }: SweepSummary): number | null {
  if (status !== "running" || done === 0 || seconds <= 0) return null;
  return (seconds / done) * (total - done);
}

/** 7 s, 2 min 5 s: more than that nobody wants to know. */
export function timeLeft(seconds: number): string {
  const whole = Math.max(1, Math.ceil(seconds));
  return whole < 60 ? `${whole} s` : duration(whole * 1e9);
}

/** A sweep with what was told of it since: the summary as it is now, and cells in the place of those of before. */
export function merged(sweep: Sweep, summary: SweepSummary, cells: readonly SweepCell[]): Sweep {
  const all = new Map(sweep.cells.map((cell) => [keyOf(cell), cell]));
  for (const cell of cells) all.set(keyOf(cell), cell);
  // What tells the news may be a whole sweep itself, an older one: its cells are not the news.
  return { ...sweep, ...summary, errors: sweep.errors, cells: cells.length === 0 ? sweep.cells : [...all.values()] };
}

export function withAccepted(sweep: Sweep, ref: CellRef, accepted: Accepted | null): Sweep {
  const cells = sweep.cells.map((cell) => (keyOf(cell) === keyOf(ref) ? { ...cell, accepted } : cell));
  return { ...sweep, cells };
}

/** Two sweeps of the list in the order of time. */
export function olderFirst(list: readonly SweepSummary[], one: number, other: number): [before: number, after: number] {
  const at = (id: number) => list.find((sweep) => sweep.id === id)?.at ?? "";
  return at(one) < at(other) || (at(one) === at(other) && one < other) ? [one, other] : [other, one];
}

/** How many statements read the flag, the code, or a detail. */
export function countReaders(reaction: Reaction, what: Reaction["readers"][number]["what"]): number {
  return reaction.readers.filter((reader) => reader.what === what).length;
}

export const CHANGES = [
  "worse",
  "better",
  "slower",
  "faster",
  "new",
  "gone",
  "same",
] as const satisfies readonly SweepChange["change"][];

/** What is worse stands first, what stayed the same last; within one kind the order of the sweep. */
export function sortedChanges(changes: readonly SweepChange[], onlyChanges: boolean): SweepChange[] {
  return changes
    .filter(({ change }) => !onlyChanges || change !== "same")
    .sort((a, b) => CHANGES.indexOf(a.change) - CHANGES.indexOf(b.change));
}
