import type { KeyboardEvent, ReactNode } from "react";
import { COLUMNS, type Column, type Order } from "../../../logic/plc/instances";
import { useWidths } from "../../../store/page/columns";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { useColumns } from "../../../ui/useColumns";
import { useGrid, useReveal } from "../../../ui/useGrid";
import type { Instance } from "../../../wire/types";
import { InstanceLine } from "./InstanceLine";

const NUMBERS: ReadonlySet<Column> = new Set(["scan", "interval", "cpu", "memory", "late", "run"]);

interface Props {
  rows: readonly Instance[];
  order: Order;
  selected: number | null;
  onOrder: (order: Order) => void;
  onSelect: (id: number) => void;
  onOpen: (instance: Instance) => void;
  onDelete: (instance: Instance) => void;
  onMenu: (instance: Instance, at: { x: number; y: number }) => void;
}

/** The rows: only the visible ones are in the page. Arrow keys select, Enter opens, Delete asks. */
export function InstanceGrid({ rows, order, selected, onOrder, onSelect, onOpen, onDelete, onMenu }: Props) {
  const grid = useGrid({ count: rows.length, keyOf: (index) => rows[index]?.id ?? index });
  const now = rows.findIndex(({ id }) => id === selected);
  const { style, grip } = useColumns(useWidths("instances"));

  // A list that was just opened scrolls to the selected instance; later it stays where the user scrolled it.
  useReveal(now, selected, grid.reveal);

  function step(to: number): void {
    const row = rows[grid.clamped(to)];
    if (row) onSelect(row.id);
  }

  function onKeyDown(event: KeyboardEvent<HTMLDivElement>): void {
    if (event.target !== event.currentTarget) return;
    const row = rows[now];
    const target = grid.stepOf(event.key, now);
    if (target !== undefined) step(target);
    else if (event.key === "Enter" && row) onOpen(row);
    else if (event.key === "Delete" && row) onDelete(row);
    else return;
    event.preventDefault();
  }

  return (
    <div
      ref={grid.scroll}
      className="grid scroll ins"
      role="grid"
      aria-label={t("instances.list")}
      aria-rowcount={rows.length + 1}
      aria-activedescendant={now >= 0 ? `instance-${rows[now]?.id}` : undefined}
      style={style}
      tabIndex={0}
      onKeyDown={onKeyDown}
    >
      <div className="gr h" role="row" aria-rowindex={1}>
        {COLUMNS.map((column) => (
          <Head key={column} column={column} order={order} onOrder={onOrder}>
            {grip(column, t(`instances.column.${column}`))}
          </Head>
        ))}
        <span role="columnheader" className="c-limits">
          {t("instances.column.limits")}
        </span>
      </div>
      <div {...grid.body}>
        {grid.items.map((item) => {
          const row = rows[item.index];
          return (
            row && (
              <InstanceLine
                key={row.id}
                instance={row}
                index={item.index}
                top={grid.topOf(item)}
                selected={row.id === selected}
                onSelect={onSelect}
                onOpen={onOpen}
                onMenu={onMenu}
              />
            )
          );
        })}
      </div>
    </div>
  );
}

interface HeadProps {
  column: Column;
  order: Order;
  onOrder: (order: Order) => void;
  children: ReactNode;
}

/** A click on a column head sorts by it; a second click reverses the order. Numbers begin with the largest. */
function Head({ column, order, onOrder, children }: HeadProps) {
  const here = order.by === column;
  const down = here ? !order.down : NUMBERS.has(column);
  return (
    <span
      role="columnheader"
      aria-label={t(`instances.column.${column}`)}
      className={`c-${column}${NUMBERS.has(column) ? " num" : ""}`}
      aria-sort={here ? (order.down ? "descending" : "ascending") : "none"}
      title={column === "late" ? t("instances.late.about") : undefined}
    >
      <button type="button" className={`sort${here ? " on" : ""}`} onClick={() => onOrder({ by: column, down })}>
        {t(`instances.column.${column}`)}
        {here && <Icon name={order.down ? "chev-d" : "chev-u"} small />}
      </button>
      {children}
    </span>
  );
}
