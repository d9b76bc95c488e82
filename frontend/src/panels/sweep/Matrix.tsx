import { type KeyboardEvent, useEffect, useRef } from "react";
import { type MatrixRow, stepIn } from "../../logic/sweep";
import { t } from "../../logic/text";
import type { CellRef, Sweep } from "../../wire/types";
import { cellId, Row } from "./Row";

const ROW = 24;

interface Props {
  sweep: Sweep;
  rows: readonly MatrixRow[];
  selected: CellRef | null;
  onSelect: (cell: CellRef) => void;
  /** Enter: on to what can be done with the cell. */
  onEnter: () => void;
}

/** Errors by states. Arrow keys move, Home and End lead along a row, with Ctrl to the corners; Enter goes to the details. */
export function Matrix({ sweep, rows, selected, onSelect, onEnter }: Props) {
  const grid = useRef<HTMLDivElement>(null);
  const { states } = sweep;
  const row = rows.findIndex((known) => known.kind === "error" && known.error.id === selected?.error);
  const column = selected ? states.indexOf(selected.state) : -1;
  const place = row >= 0 && column >= 0 ? { row, column } : null;

  // The head and the column of names cover what lies below them: the margins keep the cell clear of both.
  // biome-ignore lint/correctness/useExhaustiveDependencies: only the choice moves the grid, not the progress
  useEffect(() => {
    if (grid.current?.contains(document.activeElement) && selected)
      grid.current.querySelector(`[id="${cellId(sweep.id, row, column)}"]`)?.scrollIntoView({ block: "nearest", inline: "nearest" });
  }, [selected]);

  function onKeyDown(event: KeyboardEvent<HTMLDivElement>): void {
    if (event.altKey || event.metaKey) return;
    const page = Math.max(1, Math.floor((grid.current?.clientHeight ?? 0) / ROW) - 2);
    const key = `${event.ctrlKey ? "Ctrl+" : ""}${event.key}`;
    const to = stepIn(rows, states.length, place, key, page);
    const target = to && rows[to.row];
    const state = to && states[to.column];
    if (key === "Enter") onEnter();
    else if (target?.kind === "error" && state) onSelect({ error: target.error.id, state });
    else return;
    event.preventDefault();
  }

  if (rows.length === 0) return <p className="lonely faint swnone">{t("sweep.nomatch")}</p>;
  return (
    <div
      ref={grid}
      className="grid scroll both sw"
      style={{ "--states": states.length }}
      role="grid"
      aria-label={t("sweep.matrix")}
      aria-rowcount={rows.length + 1}
      aria-colcount={states.length + 2}
      aria-activedescendant={place ? cellId(sweep.id, row, column) : undefined}
      tabIndex={0}
      onKeyDown={onKeyDown}
    >
      <div className="gr h" role="row" aria-rowindex={1}>
        <span role="columnheader" className="swname">
          {t("errors.error")}
        </span>
        <span role="columnheader" className="swcode">
          {t("errors.code")}
        </span>
        {states.map((state) => (
          <span key={state} role="columnheader" className="colh" title={state}>
            {state}
          </span>
        ))}
      </div>
      {rows.map((known, index) => (
        <Row
          key={known.kind === "group" ? `/${known.name}` : known.error.id}
          sweep={sweep.id}
          row={known}
          index={index}
          states={states}
          column={index === row ? column : null}
          onSelect={onSelect}
        />
      ))}
    </div>
  );
}
