/** The watch list as rows: groups, entries in their order, unfolded members, and notes below their row. */

import type { PlcSymbol, Refusal, WatchEntry } from "../../wire/types";
import { splitPath } from "../format/paths";
import type { SortKey } from "../format/values";
import { corrections } from "../plc/correction";
import { type Filter, matches, type Sort, type SortColumn, sorted } from "./watchsort";

/** An array shows this many members at first, and as many more with each request. */
export const PAGE = 100;

export interface WatchNote {
  kind: "refused" | "unsent" | "unknown" | "outside";
  message: string;
  /** Near matches for an unknown name. */
  near: readonly string[];
  /** The typed value, to be offered again. */
  entry?: string;
  /** Values that would be accepted instead. */
  instead: readonly string[];
  /** What the entry was for: a write or a force. */
  verb?: "write" | "force";
}

export interface GroupRow {
  kind: "group";
  key: string;
  name: string;
  open: boolean;
  count: number;
}

interface OfEntry {
  key: string;
  path: string;
  /** The list entry that this row belongs to; equal to `path` for the entry itself. */
  root: string;
  level: number;
}

export interface ValueRow extends OfEntry {
  kind: "value";
  group: string;
  /** The format of its entry; a member may have a different one. */
  format: WatchEntry["format"];
  open: boolean;
  /** Known for members; for entries it comes with the answer of the watch. */
  symbol: PlcSymbol | null;
  /** The in-out that this row is, or is below. */
  inOut: string | null;
}

export interface NoteRow extends OfEntry {
  kind: "note";
  note: WatchNote;
}

/** The line below an in-out that says where it leads. */
export interface BindingRow extends OfEntry {
  kind: "binding";
}

/** The end of a page of members. */
export interface MoreRow extends OfEntry {
  kind: "more";
  shown: number;
  total: number;
}

export const groupKey = (name: string) => `group:${name}`;

export type WatchRow = GroupRow | ValueRow | NoteRow | BindingRow | MoreRow;

export interface WatchListView {
  entries: readonly WatchEntry[];
  groups: readonly string[];
  collapsed: ReadonlySet<string>;
  open: ReadonlySet<string>;
  /** How many members of a path are shown, where that is more than a page. */
  shown: ReadonlyMap<string, number>;
  /** Members by path, as far as they were fetched. */
  members: ReadonlyMap<string, readonly PlcSymbol[]>;
  symbols: ReadonlyMap<string, PlcSymbol>;
  notes: ReadonlyMap<string, WatchNote>;
  /** Names that the PLC does not know, with the reason. */
  refusals: ReadonlyMap<string, Refusal>;
  sort: Sort;
  filter: Filter;
  /** For a filter by state and for sorts by values that only the page knows. */
  keyOf: (path: string, column: SortColumn) => SortKey;
  isForced: (path: string) => boolean;
  hasChanged: (path: string) => boolean;
}

/** The rows to show, members after their owner. */
export function watchRows(view: WatchListView): WatchRow[] {
  const rows: WatchRow[] = [];
  const listed = sortedEntries(view);
  const filtered = view.filter.text !== "" || view.filter.only !== "all";
  for (const group of ["", ...view.groups]) {
    const entries = listed.filter((entry) => entry.group === group && passes(view, entry.path));
    if (group !== "") {
      if (filtered && entries.length === 0) continue;
      const open = !view.collapsed.has(group);
      rows.push({ kind: "group", key: groupKey(group), name: group, open, count: entries.length });
      if (!open) continue;
    }
    for (const { path, format } of entries) {
      const symbol = view.symbols.get(path) ?? null;
      addRows(rows, view, { path, root: path, group, format, level: 0, symbol, inOut: symbol?.in_out ? path : null });
    }
  }
  return rows;
}

function sortedEntries({ entries, sort, symbols, keyOf }: WatchListView): readonly WatchEntry[] {
  if (sort === null) return entries;
  const { column, down } = sort;
  const key = ({ path }: WatchEntry): SortKey => {
    if (column === "target") return path;
    if (column === "type") return symbols.get(path)?.type ?? null;
    if (column === "address") return symbols.get(path)?.address ?? null;
    return keyOf(path, column);
  };
  return sorted(entries, key, down);
}

function passes(view: WatchListView, path: string): boolean {
  const { text, only } = view.filter;
  if (only === "forced" && !view.isForced(path)) return false;
  if (only === "changed" && !view.hasChanged(path)) return false;
  if (only === "errors" && !view.refusals.has(path) && !view.notes.has(path)) return false;
  return text === "" || shows(view, path, view.symbols.get(path), text);
}

/** Whether a text occurs in an entry, or in one of its unfolded members. */
function shows(view: WatchListView, path: string, symbol: PlcSymbol | undefined, text: string): boolean {
  if (matches(text, [path, symbol?.type, symbol?.address])) return true;
  if (!view.open.has(path)) return false;
  return (view.members.get(path) ?? []).some((member) => shows(view, member.path, member, text));
}

function addRows(
  rows: WatchRow[],
  view: WatchListView,
  of: Pick<ValueRow, "path" | "root" | "group" | "format" | "level" | "symbol" | "inOut">,
): void {
  const { path, root, group, format, level, inOut } = of;
  const open = view.open.has(path);
  const named = { path, root, level };
  rows.push({ kind: "value", key: `value:${root}:${path}`, ...of, open });
  const note = view.notes.get(path) ?? unknownNote(view.refusals.get(path));
  if (note) rows.push({ kind: "note", key: `note:${root}:${path}`, ...named, note });
  if (inOut === path) rows.push({ kind: "binding", key: `binding:${root}:${path}`, ...named });
  if (!open) return;
  const members = view.members.get(path) ?? [];
  const shown = Math.max(PAGE, view.shown.get(path) ?? 0);
  for (const member of members.slice(0, shown)) {
    const below = member.in_out ? member.path : inOut;
    addRows(rows, view, { path: member.path, root, group, format, level: level + 1, symbol: member, inOut: below });
  }
  if (members.length > shown) {
    rows.push({
      kind: "more",
      key: `more:${root}:${path}`,
      path,
      root,
      level: level + 1,
      shown,
      total: members.length,
    });
  }
}

function unknownNote(refusal: Refusal | undefined): WatchNote | null {
  return refusal ? { kind: "unknown", message: refusal.message, near: refusal.near ?? [], instead: [] } : null;
}

/** The note about a refused entry, with values that would be accepted. */
export function noteOf(
  sent: boolean,
  message: string,
  near: readonly string[],
  entry: string,
  verb: "write" | "force",
): WatchNote {
  const instead = sent ? corrections(message, entry) : [];
  return { kind: sent ? "refused" : "unsent", message, near, entry, instead, verb };
}

/** The note of a value that was written although the subrange does not have it; null where it has. */
export function outsideNote(range: string, value: string, message: string): WatchNote | null {
  const bounds = /\(\s*(-?\d+)\s*\.\.\s*(-?\d+)\s*\)$/.exec(range);
  if (!bounds || !/^[+-]?\d+$/.test(value.trim())) return null;
  const number = BigInt(value.trim().replace("+", ""));
  const inside = BigInt(bounds[1] ?? 0) <= number && number <= BigInt(bounds[2] ?? 0);
  return inside ? null : { kind: "outside", message, near: [], instead: [] };
}

/** The paths to watch: entries, and members that have a value themselves. */
export function pathsToWatch(rows: readonly WatchRow[]): string[] {
  const paths = new Set<string>();
  for (const row of rows) {
    if (row.kind === "value" && (row.level === 0 || row.symbol?.expandable !== true)) paths.add(row.path);
  }
  return [...paths];
}

/** The name of a member, without its owner: `[1]` or `run`. */
export const memberName = (row: ValueRow) => row.symbol?.name || splitPath(row.path).name;

/** The variable that a member of an in-out refers to, from the argument of the in-out itself: `Main.zone[3].parts`. */
export const actualOf = (path: string, inOut: string, actual: string) => actual + path.slice(inOut.length);
