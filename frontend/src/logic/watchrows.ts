/** The watch list as rows: roots, unfolded members, and a note under a row that has something to say. */
import type { PlcSymbol, Refusal } from "../wire/types";

export interface WatchNote {
  kind: "refused" | "unsent" | "unknown";
  message: string;
  /** Near matches for a name that is not known. */
  near: string[];
  /** What was typed, to be offered again. */
  entry?: string;
}

export interface ValueRow {
  kind: "value";
  path: string;
  /** The list entry that this row stands under; equal to `path` for the entry itself. */
  root: string;
  level: number;
  open: boolean;
  /** Known for members; for roots it comes with the watch's answer. */
  symbol: PlcSymbol | null;
}

export interface NoteRow {
  kind: "note";
  path: string;
  root: string;
  level: number;
  note: WatchNote;
}

export type WatchRow = ValueRow | NoteRow;

export interface WatchListView {
  roots: readonly string[];
  open: ReadonlySet<string>;
  /** Members by path, as far as they were fetched. */
  members: ReadonlyMap<string, readonly PlcSymbol[]>;
  symbols: ReadonlyMap<string, PlcSymbol>;
  notes: ReadonlyMap<string, WatchNote>;
  /** Names that the PLC does not know, with its reason. */
  refusals: ReadonlyMap<string, Refusal>;
}

/** The rows to show, members after their owner. */
export function watchRows(view: WatchListView): WatchRow[] {
  const rows: WatchRow[] = [];
  for (const root of view.roots) addRows(rows, view, root, root, view.symbols.get(root) ?? null, 0);
  return rows;
}

function addRows(
  rows: WatchRow[],
  view: WatchListView,
  path: string,
  root: string,
  symbol: PlcSymbol | null,
  level: number,
): void {
  const open = view.open.has(path);
  rows.push({ kind: "value", path, root, level, open, symbol });
  const note = view.notes.get(path) ?? unknownNote(view.refusals.get(path));
  if (note) rows.push({ kind: "note", path, root, level, note });
  if (!open) return;
  for (const member of view.members.get(path) ?? []) addRows(rows, view, member.path, root, member, level + 1);
}

function unknownNote(refusal: Refusal | undefined): WatchNote | null {
  return refusal ? { kind: "unknown", message: refusal.message, near: refusal.near ?? [] } : null;
}

/** What to ask the PLC for: every entry, and the members that are shown and have a value of their own. */
export function pathsToWatch(rows: readonly WatchRow[]): string[] {
  const paths = new Set<string>();
  for (const row of rows) {
    if (row.kind === "value" && (row.level === 0 || row.symbol?.expandable !== true)) paths.add(row.path);
  }
  return [...paths];
}
