/** Rows of the verification that is shown: those in sight, fetched as one scrolls and as it goes on. */
import { create } from "zustand";
import { nextDifferent } from "../../logic/verify/verify";
import type { VerifyColumn, VerifyRow, VerifyUse } from "../../wire/types";
import { type VerifySource, verify as wire } from "../../wire/verify";
import { fail, type ShownVerification, shownNow, useVerify } from "./verify";

interface Rows {
  /** Of what, as text; another one begins anew. */
  of: string;
  generation: number;
  columns: readonly VerifyColumn[];
  byIndex: ReadonlyMap<number, VerifyRow>;
  /** Index of the first row that is kept. */
  first: number;
  /** Rows that there were; the last one has index `count` - 1. */
  count: number;
  differing: readonly number[];
  /** Rows that differed until then, those that were forgotten included. */
  differed: number;
  onlyDiffering: boolean;
  /** The row that is looked at, by its index. */
  selected: number | null;
  /** Of the column of cells that has the keys. */
  track: string | null;
  /** The row that was jumped to, until the table shows what differs in it. */
  sought: number | null;
  /** The cell that shall be edited, until the table does it. */
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

/** Asked for at once; more than fit a screen, so that scrolling finds them there. */
const PAGE = 120;
/** Kept around what is in sight. */
const KEPT = 4000;

/** How many lines the table has. */
export const lineCount = ({ onlyDiffering, differing, first, count }: Rows) =>
  onlyDiffering ? differing.length : count - first;

/** The index of the row in a line of the table. */
export const indexAt = ({ onlyDiffering, differing, first }: Rows, line: number) =>
  onlyDiffering ? (differing[line] ?? -1) : first + line;

/** The line of a row; -1: not among those that are shown. */
export const lineOfRow = ({ onlyDiffering, differing, first, count }: Rows, index: number) =>
  onlyDiffering ? differing.indexOf(index) : index >= first && index < count ? index - first : -1;

const keyOf = ({ kind, id }: VerifySource) => `${kind} ${id}`;

let sight = { from: 0, to: PAGE };
let underWay = false;

/** The lines in sight. */
export function seeLines(from: number, to: number): void {
  sight = { from, to };
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

/** Nothing that is kept is of what is shown now. */
function isOther(): boolean {
  const shown = shownNow();
  const rows = get();
  return shown !== null && (rows.of !== keyOf(shown.source) || rows.generation !== shown.info.generation);
}

/** What the table knows of the whole is old, though its rows need not be. */
function wantsNews(): { first: number; count: number } | null {
  const shown = shownNow();
  if (!shown || !isStale()) return null;
  const rows = get();
  const other = isOther();
  // At the end of the table the new rows come along with the news that there are some.
  if (!other && !rows.onlyDiffering && sight.to >= lineCount(rows) && shown.info.rows > rows.count)
    return { first: Math.max(rows.count, shown.info.rows - PAGE / 2), count: PAGE };
  return { first: firstInSight(), count: other ? PAGE : 0 };
}

/** One request at a time: what is in sight when it is answered is asked for next. */
async function fetchMissing(): Promise<void> {
  if (underWay) return;
  underWay = true;
  try {
    for (let goesOn = true; goesOn; ) {
      const shown = shownNow();
      // Rows in sight come first, and bring the news along: on a busy machine there is always some.
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

type Answer = Awaited<ReturnType<typeof wire.rows>>;

/** False when nothing came that was not there: asking again at once is no use, the next news of the server leads on. */
function take({ source, info }: ShownVerification, answer: Answer, asked: number): boolean {
  const before = get();
  const { generation } = info;
  const of = keyOf(source);
  const anew = before.of !== of;
  const isNew =
    anew ||
    before.generation !== generation ||
    before.count !== answer.count ||
    before.first !== answer.first ||
    before.differing.length !== answer.differing.length;
  const byIndex = new Map(anew || before.generation !== generation ? [] : before.byIndex);
  const known = byIndex.size;
  for (const row of answer.rows) byIndex.set(row.index, row);
  for (const index of byIndex.keys()) if (index < answer.first) byIndex.delete(index);
  if (byIndex.size > KEPT)
    for (const index of [...byIndex.keys()]) if (Math.abs(index - asked) > KEPT / 2) byIndex.delete(index);
  // Who stands at the newest row of one that is driven scan by scan goes along.
  const paced = shownNow()?.info.pace !== "free" && answer.count > before.count;
  const goesAlong = paced && before.selected !== null && before.selected === before.count - 1;
  const selected = anew ? null : goesAlong ? answer.count - 1 : before.selected;
  set({
    of,
    generation,
    byIndex,
    // A new array would move all cells of a table in which nothing is new.
    columns: sameColumns(before.columns, answer.columns) && !anew ? before.columns : answer.columns,
    first: answer.first,
    count: answer.count,
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
    return column.name === other?.name && column.input === other.input && column.output === other.output;
  });

// Another verification, another generation, or more rows: what is in sight comes along.
useVerify.subscribe((now, before) => {
  if (now.verifications === before.verifications && now.id === before.id && now.record === before.record) return;
  const shown = shownNow();
  if (!shown) set(nothing);
  else {
    if (get().of !== "" && get().of !== keyOf(shown.source)) set(nothing);
    void fetchMissing();
  }
});

// ---- what people do -----------------------------------------------------------------------------------------------

export function showOnlyDiffering(onlyDiffering: boolean): void {
  set({ onlyDiffering });
  void fetchMissing();
}

export function selectRow(index: number | null, track?: string | null): void {
  set({ selected: index, ...(track === undefined ? {} : { track }) });
}

/** The next one is selected as it comes. */
export function selectNewest(): void {
  const { count } = get();
  if (count > 0) set({ selected: count - 1 });
}

/** Lets somebody type into an input of a row. */
export function editInput(row: VerifyRow, name: string): void {
  set({ selected: row.index, track: `input:${name}`, wanted: { index: row.index, track: `input:${name}` } });
}

export const soughtFound = () => set({ sought: null });

export const editBegun = () => set({ wanted: null });

/** To the first, next or previous row that differs, from the one that is looked at. Null: there is none. */
export function goToDifference(which: "first" | "next" | "previous"): number | null {
  const { differing, selected } = get();
  const from = which === "first" ? null : selected;
  const found = nextDifferent(differing, from, which === "previous" ? -1 : 1);
  if (found !== null) set({ selected: found, sought: found });
  return found;
}

/** The used-variable record of a row. Throws what was refused. */
export async function usesOf(row: VerifyRow): Promise<readonly VerifyUse[]> {
  const shown = shownNow();
  return shown?.source.kind === "verification" ? wire.uses(shown.source.id, row.scan, row.call) : [];
}
