/** Rows of the shown verification: the visible ones, fetched during scrolling and as the verification continues. */
import { create } from "zustand";
import { nextDifferent } from "../../logic/verify/verify";
import type { VerifyColumn, VerifyRow, VerifyUse } from "../../wire/types";
import { type VerifySource, verify as wire } from "../../wire/verify";
import { fail, type ShownVerification, shownNow, useVerify } from "./verify";

interface Rows {
  /** The key of the source; a different source begins again. */
  of: string;
  generation: number;
  columns: readonly VerifyColumn[];
  byIndex: ReadonlyMap<number, VerifyRow>;
  /** Index of the first row that is kept. */
  first: number;
  /** Rows so far; the last one has index `count` - 1. */
  count: number;
  differing: readonly number[];
  /** Rows that differed until then, including dropped ones. */
  differed: number;
  onlyDiffering: boolean;
  /** The selected row, by its index. */
  selected: number | null;
  /** The selected column of cells. */
  track: string | null;
  /** The row of a jump, until the table has selected the differing cell. */
  sought: number | null;
  /** The cell to edit, until the table does it. */
  wanted: { index: number; track: string } | null;
}

const nothing: Omit<Rows, "onlyDiffering"> = {
  of: "",
  generation: -1,
  columns: [],
  byIndex: new Map(),
  first: 0,
  count: 0,
  differing: [],
  differed: 0,
  selected: null,
  track: null,
  sought: null,
  wanted: null,
};

export const useVerifyRows = create<Rows>(() => ({ ...nothing, onlyDiffering: false }));
const get = useVerifyRows.getState;
const set = useVerifyRows.setState;

/** The size of a request; more than a screen, so that scrolling finds rows already there. */
const PAGE = 120;
/** The number of rows kept around the visible ones. */
const KEPT = 4000;

/** The number of lines of the table. */
export const lineCount = ({ onlyDiffering, differing, first, count }: Rows) =>
  onlyDiffering ? differing.length : count - first;

/** The index of the row in a line of the table. */
export const indexAt = ({ onlyDiffering, differing, first }: Rows, line: number) =>
  onlyDiffering ? (differing[line] ?? -1) : first + line;

/** The line of a row; -1: it is not shown. */
export const lineOfRow = ({ onlyDiffering, differing, first, count }: Rows, index: number) =>
  onlyDiffering ? differing.indexOf(index) : index >= first && index < count ? index - first : -1;

const keyOf = ({ kind, id }: VerifySource) => `${kind} ${id}`;

let sight = { from: 0, to: PAGE, atEnd: false };
let underWay = false;

/** The visible lines; `atEnd`: the last line is among them, and the table goes on with the rows that come. */
export function seeLines(from: number, to: number, atEnd = false): void {
  sight = { from, to, atEnd };
  void fetchMissing();
}

function isStale(): boolean {
  const shown = shownNow();
  const rows = get();
  if (!shown) return false;
  const { info, source } = shown;
  return (
    rows.of !== keyOf(source) ||
    rows.generation !== info.generation ||
    rows.count < info.rows ||
    rows.first < info.forgotten ||
    rows.differed < info.differing
  );
}

function missing(): { first: number; count: number } | null {
  const rows = get();
  const to = Math.min(sight.to, lineCount(rows));
  for (let line = sight.from; line < to; line += 1) {
    const index = indexAt(rows, line);
    if (rows.byIndex.has(index)) continue;
    return { first: index, count: PAGE };
  }
  return null;
}

/** The kept rows do not belong to the shown verification. */
function isOther(): boolean {
  const shown = shownNow();
  const rows = get();
  return shown !== null && (rows.of !== keyOf(shown.source) || rows.generation !== shown.info.generation);
}

/** The counts and the columns are outdated, though the rows may not be. */
function wantsNews(): { first: number; count: number } | null {
  const shown = shownNow();
  if (!shown || !isStale()) return null;
  const rows = get();
  const other = isOther();
  // At the end of the table, new rows come with the same request as the counts.
  if (!other && goesOnAtEnd(rows) && shown.info.rows > rows.count)
    return { first: Math.max(rows.count, shown.info.rows - PAGE / 2), count: PAGE };
  return { first: firstInSight(), count: other ? PAGE : 0 };
}

/** One request at a time: the lines that are visible at its answer are requested next. */
async function fetchMissing(): Promise<void> {
  if (underWay) return;
  underWay = true;
  try {
    for (let goesOn = true; goesOn; ) {
      const shown = shownNow();
      // Visible rows are requested first, and the answer has the counts, too: during fast verification there are always new counts.
      const wanted = (isOther() ? null : missing()) ?? wantsNews();
      if (!shown || !wanted) return;
      const answer = await wire.rows(shown.source, wanted.first, wanted.count, get().onlyDiffering);
      goesOn = take(shown, answer, wanted.first);
    }
  } catch (error) {
    fail(error);
  } finally {
    underWay = false;
  }
}

function firstInSight(): number {
  const rows = get();
  const shown = shownNow();
  if (shown && rows.of !== keyOf(shown.source)) return shown.info.forgotten;
  return Math.max(0, indexAt(rows, Math.min(sight.from, Math.max(0, lineCount(rows) - 1))));
}

const goesOnAtEnd = ({ onlyDiffering }: Rows) => sight.atEnd && !onlyDiffering;

/** At the end, the table goes on to the last row that has come: the newest are ahead of any answer while rows come fast. */
function countNow(before: Rows, { first, count, rows }: Answer): number {
  if (!goesOnAtEnd(before)) return count;
  return Math.max(first, Math.min(count, Math.max(before.count, (rows.at(-1)?.index ?? -1) + 1)));
}

type Answer = Awaited<ReturnType<typeof wire.rows>>;

/** False when the answer contained nothing new: do not request again at once, the next message of the server does. */
function take({ source, info }: ShownVerification, answer: Answer, asked: number): boolean {
  const before = get();
  const { generation } = info;
  const of = keyOf(source);
  const anew = before.of !== of;
  const other = anew || before.generation !== generation;
  const count = other ? answer.count : countNow(before, answer);
  const isNew =
    other ||
    before.count !== count ||
    before.first !== answer.first ||
    before.differing.length !== answer.differing.length;
  const byIndex = new Map(other ? [] : before.byIndex);
  const known = byIndex.size;
  for (const row of answer.rows) byIndex.set(row.index, row);
  for (const index of byIndex.keys()) if (index < answer.first) byIndex.delete(index);
  if (byIndex.size > KEPT)
    for (const index of [...byIndex.keys()]) if (Math.abs(index - asked) > KEPT / 2) byIndex.delete(index);
  // In a verification that is driven scan by scan, a selection of the newest row moves along.
  const paced = shownNow()?.info.pace !== "free" && count > before.count;
  const goesAlong = paced && before.selected !== null && before.selected === before.count - 1;
  const selected = anew ? null : goesAlong ? count - 1 : before.selected;
  set({
    of,
    generation,
    byIndex,
    // A new array would draw all cells of the table again, although nothing is new.
    columns: sameColumns(before.columns, answer.columns) && !anew ? before.columns : answer.columns,
    first: answer.first,
    count,
    differing: answer.differing,
    differed: info.differing,
    selected: selected !== null && selected < answer.first ? null : selected,
    ...(anew ? { track: null } : {}),
  });
  return isNew || byIndex.size > known;
}

const sameColumns = (a: readonly VerifyColumn[], b: readonly VerifyColumn[]) =>
  a.length === b.length &&
  a.every((column, at) => {
    const other = b[at];
    return (
      column.name === other?.name &&
      column.input === other.input &&
      column.output === other.output &&
      column.values.length === other.values.length // of a reference they grow
    );
  });

// A different verification, a different generation, or more rows: the visible rows are updated.
useVerify.subscribe((now, before) => {
  if (now.verifications === before.verifications && now.id === before.id && now.record === before.record) return;
  const shown = shownNow();
  if (!shown) set(nothing);
  else {
    if (get().of !== "" && get().of !== keyOf(shown.source)) set(nothing);
    void fetchMissing();
  }
});

// ---- actions ------------------------------------------------------------------------------------------------------

export function showOnlyDiffering(onlyDiffering: boolean): void {
  set({ onlyDiffering });
  void fetchMissing();
}

export function selectRow(index: number | null, track?: string | null): void {
  set({ selected: index, ...(track === undefined ? {} : { track }) });
}

/** The next row is selected when it arrives. */
export function selectNewest(): void {
  const { count } = get();
  if (count > 0) set({ selected: count - 1 });
}

/** Opens an input of a row for editing. */
export function editInput(row: VerifyRow, name: string): void {
  set({ selected: row.index, track: `input:${name}`, wanted: { index: row.index, track: `input:${name}` } });
}

export const soughtFound = () => set({ sought: null });

export const editBegun = () => set({ wanted: null });

/** Goes to the first, next or previous row that differs from the selected one on. Null: there is none. */
export function goToDifference(which: "first" | "next" | "previous"): number | null {
  const { differing, selected } = get();
  const from = which === "first" ? null : selected;
  const found = nextDifferent(differing, from, which === "previous" ? -1 : 1);
  if (found !== null) set({ selected: found, sought: found });
  return found;
}

/** The record of used variables of a row. Throws the refusal. */
export async function usesOf(row: VerifyRow): Promise<readonly VerifyUse[]> {
  const shown = shownNow();
  return shown?.source.kind === "verification" ? wire.uses(shown.source.id, row.scan, row.call) : [];
}
