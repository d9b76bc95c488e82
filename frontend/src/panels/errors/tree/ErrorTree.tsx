import { type KeyboardEvent, type MouseEvent, useEffect, useRef } from "react";
import { type CatalogueRow, rowFor } from "../../../logic/errors/catalogue";
import { addErrorBreakpoint } from "../../../store/debug/debug";
import { selectError, toggleChecked, toggleGroup, useSimulator } from "../../../store/errors/simulator";
import { useWidths } from "../../../store/page/columns";
import { t } from "../../../text";
import { type MenuItem, useMenu } from "../../../ui/Menu";
import { type Columns, useColumns } from "../../../ui/useColumns";
import { Group, Leaf, RefusalRow } from "./rows";

interface Props {
  rows: readonly CatalogueRow[];
  label: string;
  /** The error below which the last refusal is shown. */
  refused: string | null;
  onGenerate: () => void;
}

/** Letters typed within this time, in ms, belong together. */
const TOGETHER = 700;

/** The catalogue. Arrows move, fold and unfold; Space ticks; Enter generates; letters jump. */
export function ErrorTree({ rows, label, refused, onGenerate }: Props) {
  const grid = useRef<HTMLDivElement>(null);
  const typed = useRef({ text: "", at: 0 });
  const selected = useSimulator((state) => state.selected);
  const now = rows.findIndex((row) => row.key === selected);
  const { open, menu } = useMenu();
  const columns = useColumns(useWidths("errors"));
  useRowInSight(grid, selected);

  /** A right-click opens the menu for the row below the pointer, the menu key opens it for the selected row. */
  function onContextMenu(event: MouseEvent): void {
    const below = (event.target as HTMLElement).closest<HTMLElement>("[data-key]")?.dataset.key ?? selected;
    const row = rows.find(({ key }) => key === below);
    if (row?.kind !== "error") return;
    event.preventDefault();
    selectError(row.key);
    const raised: MenuItem = {
      label: t("debug.break.error"),
      icon: "bp-data",
      onSelect: () => void addErrorBreakpoint(row.error.id),
    };
    open([raised], { x: event.clientX, y: event.clientY });
  }

  function move(index: number): void {
    const row = rows[Math.max(0, Math.min(rows.length - 1, index))];
    if (row) selectError(row.key);
  }

  function sideways(row: CatalogueRow | undefined, unfold: boolean): void {
    if (row?.kind === "group" && row.open !== unfold) toggleGroup(row.key);
    else if (unfold && row?.kind === "group") move(now + 1);
    else if (!unfold && row) {
      const parent = rows.slice(0, now).findLastIndex((before) => before.level < row.level);
      if (parent >= 0) move(parent);
    }
  }

  function jump(event: KeyboardEvent): void {
    const fresh = event.timeStamp - typed.current.at > TOGETHER;
    const text = (fresh ? "" : typed.current.text) + event.key;
    typed.current = { text, at: event.timeStamp };
    // The first letter searches from the next row on; with more letters the current row may still match.
    const row = rowFor(rows, text, text.length === 1 ? now + 1 : Math.max(0, now));
    if (row) selectError(row.key);
  }

  function onKeyDown(event: KeyboardEvent): void {
    if (event.target !== event.currentTarget || event.ctrlKey || event.metaKey || event.altKey) return;
    const row = rows[now];
    const to = { ArrowDown: now + 1, ArrowUp: now - 1, Home: 0, End: rows.length - 1 }[event.key];
    if (to !== undefined) move(to);
    else if (event.key === "PageDown") move(now + 10);
    else if (event.key === "PageUp") move(now - 10);
    else if (event.key === "ArrowRight") sideways(row, true);
    else if (event.key === "ArrowLeft") sideways(row, false);
    else if (event.key === " ") {
      if (row) toggleChecked(row.kind === "group" ? row.ids : row.keys);
    } else if (event.key === "Enter") onGenerate();
    else if (event.key.length === 1) jump(event);
    else return;
    event.preventDefault();
  }

  return (
    <div
      ref={grid}
      className="grid errs scroll"
      role="treegrid"
      aria-label={label}
      aria-activedescendant={now >= 0 ? `error-${now}` : undefined}
      style={columns.style}
      tabIndex={0}
      onKeyDown={onKeyDown}
      onContextMenu={onContextMenu}
      onFocus={(event) => {
        // A click also moves the focus here, and the rows must not move below the pointer.
        if (now < 0 && event.currentTarget.matches(":focus-visible")) move(0);
      }}
    >
      <Head {...columns} />
      {rows.map((row, index) =>
        row.kind === "group" ? (
          <Group key={row.key} row={row} index={index} selected={row.key === selected} />
        ) : (
          <Leaf key={row.key} row={row} index={index} selected={row.key === selected}>
            {row.key === refused && <RefusalRow error={row.error} />}
          </Leaf>
        ),
      )}
      {rows.length === 0 && <p className="lonely faint">{t("errors.nomatch")}</p>}
      {menu}
    </div>
  );
}

function Head({ head }: Columns) {
  return (
    <div className="gr h" role="row">
      {head("name", t("errors.error"), "first")}
      {head("code", t("errors.code"), "c-code")}
      {head("flag", t("errors.flag"), "c-flag")}
      {head("severity", t("errors.severity"), "c-severity")}
      {head("state", t("errors.state"), "c-state")}
      <span role="columnheader" className="c-reaction">
        {t("errors.reaction")}
        <span className="scans">{t("errors.reaction.scans")}</span>
      </span>
    </div>
  );
}

/** The details of the selected error take room from the tree: they must not push its row out of view. */
function useRowInSight(grid: { current: HTMLDivElement | null }, selected: string | null): void {
  useEffect(() => {
    const tree = grid.current;
    if (selected === null || !tree) return;
    // Called at once, and again whenever the details grow.
    const resized = new ResizeObserver(() => {
      for (const row of tree.querySelectorAll(`[data-key="${CSS.escape(selected)}"], .refusalrow`))
        row.scrollIntoView({ block: "nearest" });
    });
    resized.observe(tree);
    return () => resized.disconnect();
  }, [grid, selected]);
}
