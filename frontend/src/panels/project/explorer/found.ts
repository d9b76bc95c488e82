/** The rows of a tree with a text in their names, and the rows that they are in. */
import type { TreeRow } from "../../../ui/Tree";

export function rowsWith(rows: readonly TreeRow[], text: string): readonly TreeRow[] {
  const looked = text.trim().toLowerCase();
  if (looked === "") return rows;
  const kept: TreeRow[] = [];
  // From the end: what is above the last kept row, and less deep, is what that row is in.
  let last = 0;
  for (const row of rows.toReversed()) {
    if (!row.name.toLowerCase().includes(looked) && row.level >= last) continue;
    kept.push(row);
    last = row.level;
  }
  return kept.reverse();
}
