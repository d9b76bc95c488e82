import type { CSSProperties, ReactNode } from "react";
import { Grip } from "./Grip";

interface Kept {
  widths: Readonly<Record<string, number>>;
  setWidth: (column: string, width: number | null) => void;
}

export interface Columns {
  /** For the element of the table: chosen widths as custom properties. */
  style: CSSProperties;
  /** The handle in a column's head; `name` is what the head says. */
  grip: (column: string, name: string) => ReactNode;
  /** A head that is only its name. */
  head: (column: string, name: string, className?: string) => ReactNode;
  /** The same for a `<table>`, whose heads have their widths themselves. */
  th: (column: string, name: string, className?: string) => ReactNode;
}

/** Pixels of a letter of the code font, the wider one, and those of a cell's padding. */
const LETTER = 7.3;
const PADDING = 20;

/** What the longest of these texts needs in a column: rows that are grids of their own cannot find out together. */
export const roomFor = (texts: readonly string[]): string =>
  `${Math.ceil(texts.reduce((longest, text) => Math.max(longest, text.length), 0) * LETTER + PADDING)}px`;

/**
 * Columns that can be made wider and narrower. A style sheet uses a chosen width as a track, `var(--w-at, 84px)`: where the table is too
 * narrow for all of them, each gives way, and the last column has what is left. Tables whose cells decide their width use `var(--px-at)`.
 */
export function useColumns({ widths, setWidth }: Kept): Columns {
  const style = Object.entries(widths).flatMap(([column, width]) => [
    [`--w-${column}`, `minmax(40px, ${width}px)`],
    [`--px-${column}`, `${width}px`],
  ]);
  const grip = (column: string, name: string) => (
    <Grip column={name} width={widths[column]} onWidth={(width) => setWidth(column, width)} />
  );
  return {
    style: Object.fromEntries(style) as CSSProperties,
    grip,
    head: (column, name, className) => (
      <span key={column} role="columnheader" aria-label={name} className={className}>
        {name}
        {grip(column, name)}
      </span>
    ),
    th: (column, name, className) => (
      <th key={column} scope="col" aria-label={name} className={className} style={{ width: widths[column] }}>
        {name}
        {grip(column, name)}
      </th>
    ),
  };
}
