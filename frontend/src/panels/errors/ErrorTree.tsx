import { type KeyboardEvent, useEffect, useRef } from "react";
import type { CatalogueRow, GroupRow, LeafRow } from "../../logic/catalogue";
import { t } from "../../logic/text";
import { selectError, toggleChecked, toggleGroup, useSimulator } from "../../store/simulator";
import { Checkbox } from "../../ui/Checkbox";
import { Icon } from "../../ui/Icon";
import { StateWord } from "../../ui/StateWord";
import { STATUS_ICONS } from "../../ui/statuses";

/** The catalogue. Arrow keys move, Space ticks, Right and Left unfold and fold. */
export function ErrorTree({ rows, label }: { rows: readonly CatalogueRow[]; label: string }) {
  const grid = useRef<HTMLDivElement>(null);
  const selected = useSimulator((state) => state.selected);
  const now = rows.findIndex((row) => row.key === selected);

  // The details of the selected error take room from the tree: it must not push its own row out of sight.
  useEffect(() => {
    const tree = grid.current;
    if (selected === null || !tree) return;
    // Called at once, and again whenever the details grow.
    const resized = new ResizeObserver(() =>
      tree.querySelector(`[data-key="${CSS.escape(selected)}"]`)?.scrollIntoView({ block: "nearest" }),
    );
    resized.observe(tree);
    return () => resized.disconnect();
  }, [selected]);

  function move(index: number): void {
    const row = rows[Math.max(0, Math.min(rows.length - 1, index))];
    if (!row) return;
    selectError(row.key);
  }

  function onKeyDown(event: KeyboardEvent): void {
    const row = rows[now];
    switch (event.key) {
      case "ArrowDown":
        move(now + 1);
        break;
      case "ArrowUp":
        move(now - 1);
        break;
      case "Home":
        move(0);
        break;
      case "End":
        move(rows.length - 1);
        break;
      case "ArrowRight":
        if (row?.kind === "group" && !row.open) toggleGroup(row.key);
        break;
      case "ArrowLeft":
        if (row?.kind === "group" && row.open) toggleGroup(row.key);
        break;
      case " ":
        if (row) toggleChecked(row.kind === "group" ? row.ids : [row.error.id]);
        break;
      default:
        return;
    }
    event.preventDefault();
  }

  return (
    <div
      ref={grid}
      className="grid errs scroll"
      role="treegrid"
      aria-label={label}
      aria-activedescendant={now >= 0 ? `error-${now}` : undefined}
      tabIndex={0}
      onKeyDown={onKeyDown}
      onFocus={(event) => {
        // A click brings the focus, too, and the rows must not move away below the pointer.
        if (now < 0 && event.currentTarget.matches(":focus-visible")) move(0);
      }}
    >
      <div className="gr h" role="row">
        <span role="columnheader" className="first">
          {t("errors.error")}
        </span>
        <span role="columnheader" className="c-code">
          {t("errors.code")}
        </span>
        <span role="columnheader">{t("errors.state")}</span>
      </div>
      {rows.map((row, index) =>
        row.kind === "group" ? (
          <Group key={row.key} row={row} index={index} selected={row.key === selected} />
        ) : (
          <Leaf key={row.key} row={row} index={index} selected={row.key === selected} />
        ),
      )}
      {rows.length === 0 && <p className="lonely faint">{t("errors.nomatch")}</p>}
    </div>
  );
}

function Group({ row, index, selected }: { row: GroupRow; index: number; selected: boolean }) {
  return (
    <div
      id={`error-${index}`}
      className={`gr grp${selected ? " on" : ""}`}
      role="row"
      style={{ "--lv": row.level }}
      aria-level={row.level + 1}
      aria-expanded={row.open}
      aria-selected={selected}
      data-key={row.key}
      onClick={() => toggleGroup(row.key)}
    >
      <span className="name" role="gridcell">
        <Icon name={row.open ? "chev-d" : "chev-r"} className="tw" />
        <Checkbox label={row.name} check={row.check} onToggle={() => toggleChecked(row.ids)} />
        <span className="cut">{row.name}</span>
      </span>
      <span className="tested" role="gridcell">
        {t("errors.tested", { tested: row.tested, total: row.ids.length })}
      </span>
    </div>
  );
}

function Leaf({ row, index, selected }: { row: LeafRow; index: number; selected: boolean }) {
  const { error } = row;
  return (
    <div
      id={`error-${index}`}
      className={`gr${selected ? " on" : ""}`}
      role="row"
      style={{ "--lv": row.level + 1 }}
      aria-level={row.level + 1}
      aria-selected={selected}
      data-key={row.key}
      title={error.description}
      onClick={() => selectError(error.id)}
    >
      <span className="name" role="gridcell">
        <Checkbox
          label={error.name}
          check={row.checked ? "all" : "none"}
          onToggle={() => {
            toggleChecked([error.id]);
            selectError(error.id);
          }}
        />
        <span className="cut">{error.name}</span>
      </span>
      <span className="mono muted c-code" role="gridcell">
        {row.code}
      </span>
      <span role="gridcell">
        <StateWord tone={row.status} icon={STATUS_ICONS[row.status]} word={t(`errors.status.${row.status}`)} />
      </span>
    </div>
  );
}
