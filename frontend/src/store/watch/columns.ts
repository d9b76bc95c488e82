/** Widths of the watch table's columns that somebody dragged; the other columns share the rest. */
import { create } from "zustand";
import { keep, recall } from "../page/localStorage";

export const WATCH_COLUMNS = ["current", "change", "type", "address", "bound"] as const;
export type WatchColumn = (typeof WATCH_COLUMNS)[number];

type Widths = Partial<Record<WatchColumn, number>>;

export const useColumns = create<Widths>(() => recall<Widths>("columns", {}));

/** Null restores the default width of a column. */
export function setColumn(column: WatchColumn, width: number | null): void {
  const { [column]: _before, ...others } = useColumns.getState();
  const next: Widths = width === null ? others : { ...others, [column]: width };
  useColumns.setState(next, true);
  keep("columns", next);
}
