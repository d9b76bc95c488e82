import { type KeyboardEvent, useEffect } from "react";
import { type MatrixRow, type Place, stateWord, stepIn } from "../../../logic/errors/sweep";
import { useWidths } from "../../../store/page/columns";
import { t } from "../../../text";
import { useColumns } from "../../../ui/useColumns";
import { ROW, useGrid } from "../../../ui/useGrid";
import type { CellRef, Sweep } from "../../../wire/types";
import { cellId, Row } from "./Row";

const GROUP = 28;

interface Props {
  sweep: Sweep;
  rows: readonly MatrixRow[];
  selected: CellRef | null;
  onSelect: (cell: CellRef) => void;
  /** Enter: moves the focus to the actions for the cell. */
  onEnter: () => void;
}

/** Errors by states; only the visible rows are in the page. Arrow keys move, Home and End move along a row, with Ctrl to the corners. */
export function Matrix({ sweep, rows, selected, onSelect, onEnter }: Props) {
  const { states } = sweep;
  const row = rows.findIndex((known) => known.kind === "error" && known.error.id === selected?.error);
  const column = selected ? states.indexOf(selected.state) : -1;
  const place = row >= 0 && column >= 0 ? { row, column } : null;
  const { style, grip, head } = useColumns(useWidths("matrix"));
  const { virtual, ...lines } = useGrid({
    count: rows.length,
    heightOf: (index) => (rows[index]?.kind === "group" ? GROUP : ROW),
    keyOf: (index) => keyOf(rows[index], index),
  });
  const grid = lines.scroll;

  // A different view has different rows, with different heights.
  // biome-ignore lint/correctness/useExhaustiveDependencies: the rows are the reason
  useEffect(() => virtual.measure(), [rows.length]);
  // Scrolls when the matrix opens and when a key moves the selection; progress never moves the view.
  // biome-ignore lint/correctness/useExhaustiveDependencies: runs once, see above
  useEffect(() => {
    if (place) virtual.scrollToIndex(row);
  }, []);

  function bringIntoSight(to: Place): void {
    virtual.scrollToIndex(to.row);
    // The sticky columns of names and codes cover the cells below them.
    const [names, , ...heads] = grid.current?.querySelectorAll<HTMLElement>("[role=columnheader]") ?? [];
    const head = heads[to.column];
    if (!grid.current || !names || !head) return;
    const covered = head.parentElement?.querySelector<HTMLElement>(".swcode");
    const left = names.offsetWidth + (covered?.offsetWidth ?? 0);
    const { scrollLeft, clientWidth } = grid.current;
    if (head.offsetLeft < scrollLeft + left) grid.current.scrollLeft = head.offsetLeft - left;
    else if (head.offsetLeft + head.offsetWidth > scrollLeft + clientWidth)
      grid.current.scrollLeft = head.offsetLeft + head.offsetWidth - clientWidth;
  }

  function onKeyDown(event: KeyboardEvent<HTMLDivElement>): void {
    if (event.altKey || event.metaKey) return;
    const page = Math.max(1, Math.floor((grid.current?.clientHeight ?? 0) / ROW) - 2);
    const key = `${event.ctrlKey ? "Ctrl+" : ""}${event.key}`;
    const to = stepIn(rows, states.length, place, key, page);
    const target = to ? rows[to.row] : undefined;
    const state = to ? states[to.column] : undefined;
    if (key === "Enter") onEnter();
    else if (to && target?.kind === "error" && state !== undefined) {
      onSelect({ error: target.error.id, state });
      bringIntoSight(to);
    } else return;
    event.preventDefault();
  }

  if (rows.length === 0) return <p className="lonely faint swnone">{t("sweep.nomatch")}</p>;
  return (
    <div
      ref={grid}
      className="grid scroll both sw"
      style={{ ...style, "--states": states.length }}
      role="grid"
      aria-label={t("sweep.matrix")}
      aria-rowcount={rows.length + 1}
      aria-colcount={states.length + 2}
      aria-activedescendant={place ? cellId(sweep.id, row, column) : undefined}
      tabIndex={0}
      onKeyDown={onKeyDown}
    >
      <div className="gr h" role="row" aria-rowindex={1}>
        {head("name", t("errors.error"), "swname")}
        {head("code", t("errors.code"), "swcode")}
        {states.map((state) => (
          <span key={state} role="columnheader" aria-label={stateWord(state)} className="colh" title={stateWord(state)}>
            {stateWord(state)}
            {grip("state", stateWord(state))}
          </span>
        ))}
      </div>
      <div {...lines.body}>
        {lines.items.map((item) => {
          const { index, key } = item;
          const known = rows[index];
          return (
            known && (
              <Row
                key={key}
                sweep={sweep.id}
                row={known}
                index={index}
                top={lines.topOf(item)}
                states={states}
                column={index === row ? column : null}
                onSelect={onSelect}
              />
            )
          );
        })}
      </div>
    </div>
  );
}

function keyOf(row: MatrixRow | undefined, index: number): string | number {
  if (!row) return index;
  return row.kind === "group" ? `/${row.name}` : row.error.id;
}
