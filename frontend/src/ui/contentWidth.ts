/** How wide a column must be to show what the drawn rows have in it. */

const TABLES = "[role=table], [role=grid], [role=treegrid], table, [data-columns]";
const ROWS = ".gr, tr";
/** Cells of a column begin at the same place; half a pixel is lost by rounding. */
const SAME = 1;

export function contentWidth(head: HTMLElement): number {
  const left = head.getBoundingClientRect().left;
  const rows = [...(head.closest(TABLES)?.querySelectorAll<HTMLElement>(ROWS) ?? [])];
  const cells = rows.flatMap((row) =>
    [...row.children].filter(
      (cell): cell is HTMLElement =>
        cell instanceof HTMLElement &&
        Math.abs(cell.getBoundingClientRect().left - left) < SAME &&
        isOneColumn(cell, row),
    ),
  );
  return Math.ceil(Math.max(...[head, ...cells].map(naturalWidth)));
}

/** A cell that spans columns says nothing about one of them. */
function isOneColumn(cell: HTMLElement, row: HTMLElement): boolean {
  return row.children.length > 1 && !cell.matches("[colspan], [aria-colspan]") && cell.offsetParent !== null;
}

/** Outside of its row, a cell is as wide as its content. It is back before anything is painted. */
function naturalWidth(cell: HTMLElement): number {
  const before = cell.getAttribute("style");
  cell.style.setProperty("position", "absolute", "important");
  cell.style.width = "max-content";
  cell.style.maxWidth = "none";
  const { width } = cell.getBoundingClientRect();
  if (before === null) cell.removeAttribute("style");
  else cell.setAttribute("style", before);
  return width;
}
