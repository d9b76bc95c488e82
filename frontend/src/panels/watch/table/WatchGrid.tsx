import { type ClipboardEvent, type CSSProperties, type KeyboardEvent, type Ref, useEffect, useRef } from "react";
import { pathsIn } from "../../../logic/format/paths";
import { fromCsv } from "../../../logic/watch/watchcsv";
import { pathsToWatch, type WatchRow } from "../../../logic/watch/watchrows";
import { useWidths } from "../../../store/page/columns";
import { addAll, addToWatch, select, useWatchList, watchInSight, watchNothing } from "../../../store/watch/watchlist";
import { t } from "../../../text";
import { useMenu } from "../../../ui/Menu";
import { useColumns } from "../../../ui/useColumns";
import { belowRow, useGrid, useReveal } from "../../../ui/useGrid";
import { BindingLine } from "./BindingLine";
import { GridHead } from "./GridHead";
import { GroupLine } from "./GroupLine";
import { gridKey } from "./gridKeys";
import { MoreLine } from "./MoreLine";
import { NoteLine } from "./NoteLine";
import { groupMenu, rowMenu } from "./rowMenu";
import { useRowDrop } from "./useRowDrop";
import { ValueLine } from "./ValueLine";

interface Props {
  rows: readonly WatchRow[];
  onNewGroup: (path: string) => void;
  onRenameGroup: (name: string) => void;
}

/** The rows: only the visible ones are in the page, and are watched. The grid has the focus, the selected row is its active descendant. */
export function WatchGrid({ rows, onNewGroup, onRenameGroup }: Props) {
  const { open, menu } = useMenu();
  const selected = useWatchList((list) => list.selected);
  const columns = useColumns(useWidths("watch"));
  const drop = useRowDrop(rows);
  const grid = useGrid({ count: rows.length, keyOf: (index) => rows[index]?.key ?? index });
  const now = rows.findIndex((row) => selectsAs(row) === selected && selected !== null);
  useInSight(rows, grid.from, grid.to);
  useReveal(now, selected, grid.reveal);
  useRevealNote(rows, grid.reveal);

  function go(to: number, by: 1 | -1): void {
    for (let i = grid.clamped(to); i >= 0 && i < rows.length; i += by) {
      const name = rows[i] && selectsAs(rows[i] as WatchRow);
      if (!name) continue;
      select(name);
      grid.reveal(i);
      return;
    }
  }

  function onKeyDown(event: KeyboardEvent<HTMLDivElement>): void {
    if ((event.target as HTMLElement).matches("input, .grip")) return;
    const to = grid.stepOf(event.key, now);
    // Rows that are only notes are skipped, in the direction of the key.
    if (to !== undefined) go(to, ["ArrowUp", "PageUp", "End"].includes(event.key) ? -1 : 1);
    else if (event.key === "ContextMenu") {
      if (rows[now]) showMenu(rows[now], belowRow(event.currentTarget));
    } else if (!gridKey(event, rows[now])) return;
    event.preventDefault();
  }

  function showMenu(row: WatchRow, at: { x: number; y: number }): void {
    if (row.kind === "group") open(groupMenu(row, onRenameGroup), at);
    else if (row.kind === "value") open(rowMenu(row, onNewGroup), at);
  }

  return (
    <div
      ref={grid.scroll}
      className="grid wt scroll"
      role="treegrid"
      aria-label={t("watch.table")}
      style={columns.style}
      aria-rowcount={rows.length + 1}
      aria-activedescendant={grid.isDrawn(now) ? `watch-${now}` : undefined}
      tabIndex={0}
      onKeyDown={onKeyDown}
      onPaste={paste}
      onDragOver={drop.onDragOver}
      onDragLeave={drop.onDragLeave}
      onDragEnd={drop.onDragEnd}
      onDrop={drop.onDrop}
      onFocus={(event) => {
        // A click also moves the focus here, and the rows must not move below the pointer.
        if (now < 0 && event.currentTarget.matches(":focus-visible")) go(0, 1);
      }}
    >
      <GridHead grip={columns.grip} />
      <div {...grid.body}>
        {grid.items.map((item) => {
          const row = rows[item.index];
          if (!row) return null;
          const level = row.kind === "group" ? 0 : row.level;
          const line = { index: item.index, style: { transform: `translateY(${grid.topOf(item)}px)`, "--lv": level } };
          return (
            <Line
              key={item.key}
              row={row}
              line={line}
              selected={selected !== null && selectsAs(row) === selected}
              target={row.kind === "value" && row.level === 0 && drop.before?.before === row.root}
              measured={grid.virtual.measureElement}
              onMenu={showMenu}
            />
          );
        })}
      </div>
      {menu}
    </div>
  );
}

interface LineProps {
  row: WatchRow;
  line: { index: number; style: CSSProperties };
  selected: boolean;
  target: boolean;
  measured: Ref<HTMLDivElement>;
  onMenu: (row: WatchRow, at: { x: number; y: number }) => void;
}

function Line({ row, line, selected, target, measured, onMenu }: LineProps) {
  const menu = (at: { x: number; y: number }) => onMenu(row, at);
  switch (row.kind) {
    case "group":
      return <GroupLine row={row} {...line} selected={selected} onSelect={() => select(row.key)} onMenu={menu} />;
    case "note":
      return <NoteLine row={row} {...line} measured={measured} />;
    case "binding":
      return <BindingLine row={row} {...line} />;
    case "more":
      return <MoreLine row={row} {...line} />;
    case "value":
      return <ValueLine row={row} {...line} selected={selected} target={target} onMenu={menu} />;
  }
}

/** The path by which a row is selected; notes cannot be selected. */
const selectsAs = (row: WatchRow) => (row.kind === "value" ? row.path : row.kind === "group" ? row.key : null);

function useInSight(rows: readonly WatchRow[], from: number, to: number): void {
  const sort = useWatchList((list) => list.sort);
  const filter = useWatchList((list) => list.filter);
  // biome-ignore lint/correctness/useExhaustiveDependencies: a different sort or filter needs different values
  useEffect(() => watchInSight(pathsToWatch(rows.slice(from, to))), [rows, from, to, sort, filter]);
  useEffect(() => watchNothing, []);
}

/** Scrolls to the reason of a refusal: it may be below the last visible row. */
function useRevealNote(rows: readonly WatchRow[], reveal: (index: number) => void): void {
  const notes = useWatchList((list) => list.notes);
  const before = useRef(notes);
  useEffect(() => {
    if (before.current === notes) return;
    const index = rows.findIndex(
      (row) => row.kind === "note" && notes.has(row.path) && before.current.get(row.path) !== notes.get(row.path),
    );
    before.current = notes;
    if (index >= 0) reveal(index);
  }, [rows, notes, reveal]);
}

/** Many lines are many entries; lines from a CSV file also have formats and groups. */
function paste(event: ClipboardEvent): void {
  if ((event.target as HTMLElement).matches("input")) return;
  const text = event.clipboardData.getData("text/plain");
  event.preventDefault();
  if (/^\uFEFF?"?path"?[;,\t]/i.test(text)) addAll(fromCsv(text).entries);
  else addToWatch(pathsIn(text));
}
