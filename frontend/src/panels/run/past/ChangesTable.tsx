import { useMemo, useState } from "react";
import { changesAsText, filterChanges, leftOut } from "../../../logic/past/past";
import { useWidths } from "../../../store/page/columns";
import { showWriter } from "../../../store/past/writer";
import { t } from "../../../text";
import { CopyButton } from "../../../ui/CopyButton";
import { Icon } from "../../../ui/Icon";
import { IconButton } from "../../../ui/IconButton";
import { useColumns } from "../../../ui/useColumns";
import { useGrid } from "../../../ui/useGrid";
import type { RunChanges, VariableChange } from "../../../wire/types";

interface Props {
  changes: RunChanges;
  label: string;
  /** The headings of the two value columns. */
  heads: readonly [string, string];
  /** The scan for the question who last wrote the variable; null: the question is not offered. */
  writerBefore: number | null;
}

/** Variables with two values each, with a filter and a copy button. Only the visible rows are in the page. */
export function ChangesTable({ changes, label, heads, writerBefore }: Props) {
  const [filter, setFilter] = useState("");
  const shown = useMemo(() => filterChanges(changes.changes, filter), [changes, filter]);
  const missing = leftOut(changes);
  return (
    <>
      <div className="row">
        <span className="inp sm filter">
          <Icon name="search" small />
          <input
            type="search"
            aria-label={t("changes.filter")}
            placeholder={t("changes.filter")}
            value={filter}
            spellCheck={false}
            onChange={(event) => setFilter(event.target.value)}
          />
        </span>
        <span className="hint" role="status">
          {filter.trim() === ""
            ? t(changes.at_least ? "changes.count.least" : "changes.count", { count: changes.count })
            : t("changes.shown", { shown: shown.length, count: changes.changes.length })}
          {missing > 0 && (
            <span className="bad">
              {" "}
              {t(changes.at_least ? "changes.leftout.least" : "changes.leftout", { count: missing })}
            </span>
          )}
        </span>
        <span className="grow" />
        <CopyButton
          label={t("changes.copy")}
          done={t("changes.copied")}
          className="btn quiet sm"
          icon="export"
          text={() => changesAsText(shown, heads)}
        />
      </div>
      {shown.length === 0 ? (
        <p className="lonely faint">{t("changes.nomatch")}</p>
      ) : (
        <Rows rows={shown} label={label} heads={heads} writerBefore={writerBefore} />
      )}
    </>
  );
}

interface RowsProps extends Omit<Props, "changes"> {
  rows: readonly VariableChange[];
}

function Rows({ rows, label, heads, writerBefore }: RowsProps) {
  const grid = useGrid({ count: rows.length, keyOf: (index) => rows[index]?.path ?? index });
  const { style, head } = useColumns(useWidths("changes"));
  return (
    <div
      ref={grid.scroll}
      className="grid scroll chtable"
      role="table"
      aria-label={label}
      aria-rowcount={rows.length + 1}
      style={style}
      // biome-ignore lint/a11y/noNoninteractiveTabindex: a scrolling region must be reachable by keyboard
      tabIndex={0}
    >
      <div className="gr h" role="row" aria-rowindex={1}>
        {head("variable", t("changes.variable"))}
        {head("type", t("changes.type"))}
        {head("before", heads[0], "num")}
        {head("after", heads[1], "num")}
        <span role="columnheader">
          <span className="sr">{t("writer.menu")}</span>
        </span>
      </div>
      <div {...grid.body}>
        {grid.items.map((item) => {
          const row = rows[item.index];
          return (
            row && (
              <Row key={row.path} row={row} index={item.index} top={grid.topOf(item)} writerBefore={writerBefore} />
            )
          );
        })}
      </div>
    </div>
  );
}

interface RowProps {
  row: VariableChange;
  index: number;
  top: number;
  writerBefore: number | null;
}

function Row({ row, index, top, writerBefore }: RowProps) {
  const { path, type, before_shown: before, after_shown: after } = row;
  return (
    <div
      className="gr"
      role="row"
      aria-rowindex={index + 2}
      data-path={path}
      style={{ transform: `translateY(${top}px)` }}
    >
      <span role="rowheader" className="mono cut" title={path}>
        {path}
      </span>
      <span role="cell" className="muted cut" title={type}>
        {type}
      </span>
      <span role="cell" className="num cut" title={before}>
        {before}
      </span>
      <span role="cell" className="num cut now" title={after}>
        {after}
      </span>
      <span role="cell" className="askwho">
        {writerBefore !== null && (
          <IconButton
            icon="past"
            small
            label={t("writer.title", { path })}
            onClick={() => showWriter(path, writerBefore)}
          />
        )}
      </span>
    </div>
  );
}
