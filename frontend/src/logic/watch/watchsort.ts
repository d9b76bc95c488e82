/** Sorts the entries of a watch list by a column, and filters them. */
import type { SortKey } from "../format/values";

const SORT_COLUMNS = ["target", "current", "change", "type", "address", "bound"] as const;
export type SortColumn = (typeof SORT_COLUMNS)[number];

/** Null is the order of the list. */
export type Sort = { column: SortColumn; down: boolean } | null;

export const ONLY = ["all", "changed", "forced", "errors"] as const;
type Only = (typeof ONLY)[number];

export interface Filter {
  text: string;
  only: Only;
}

const natural = new Intl.Collator("en", { numeric: true, sensitivity: "base" });

export function sorted<T>(rows: readonly T[], keyOf: (row: T) => SortKey, down: boolean): readonly T[] {
  const keyed = rows.map((row) => ({ row, key: keyOf(row) }));
  keyed.sort((a, b) => {
    if (a.key === null || b.key === null) return Number(a.key === null) - Number(b.key === null);
    return (down ? -1 : 1) * compared(a.key, b.key);
  });
  return keyed.map(({ row }) => row);
}

function compared(a: Exclude<SortKey, null>, b: Exclude<SortKey, null>): number {
  if (typeof a === "string" || typeof b === "string") {
    if (typeof a === typeof b) return natural.compare(a as string, b as string);
    return typeof a === "string" ? 1 : -1;
  }
  return a < b ? -1 : a > b ? 1 : 0;
}

/** Clicks on the head of a column: up, down, as listed. */
export function nextSort(sort: Sort, column: SortColumn): Sort {
  if (sort?.column !== column) return { column, down: false };
  return sort.down ? null : { column, down: true };
}

export const matches = (text: string, parts: readonly (string | null | undefined)[]) =>
  text === "" || parts.some((part) => part?.toLowerCase().includes(text.toLowerCase()));

/** Whether every entry must be watched, not only the visible ones. */
export const needsAll = (sort: Sort, filter: Filter) =>
  (sort !== null && ["current", "type", "address"].includes(sort.column)) ||
  filter.only === "changed" ||
  filter.only === "errors";
