/** Widths of columns that somebody chose in this browser, by table and column; the other columns keep those of the style sheet. */
import { create } from "zustand";
import { keep, recall } from "./localStorage";

export type Widths = Readonly<Record<string, number>>;

const KEY = "widths";
const NONE: Widths = {};

/** Kept by a different version, or changed by hand: only what is a width counts. */
function valid(kept: Readonly<Record<string, unknown>>): Record<string, Widths> {
  const tables = Object.entries(kept).filter(([, widths]) => typeof widths === "object" && widths !== null);
  return Object.fromEntries(
    tables.map(([table, widths]) => [
      table,
      Object.fromEntries(Object.entries(widths as object).filter(([, width]) => Number.isFinite(width))),
    ]),
  );
}

const useKept = create<{ of: Readonly<Record<string, Widths>> }>(() => ({ of: valid(recall(KEY, {})) }));

/** Null restores the width of the style sheet. */
function setWidth(table: string, column: string, width: number | null): void {
  const { [column]: _before, ...others } = useKept.getState().of[table] ?? NONE;
  const of = { ...useKept.getState().of, [table]: width === null ? others : { ...others, [column]: width } };
  useKept.setState({ of });
  keep(KEY, of);
}

export interface KeptWidths {
  widths: Widths;
  setWidth: (column: string, width: number | null) => void;
}

/** The widths of a table, and how to change one. */
export function useWidths(table: string): KeptWidths {
  const widths = useKept(({ of }) => of[table] ?? NONE);
  return { widths, setWidth: (column, width) => setWidth(table, column, width) };
}
