import { useVirtualizer } from "@tanstack/react-virtual";
import { type CSSProperties, type KeyboardEvent, useRef, useState } from "react";
import { t } from "../../logic/text";
import type { ValueRow, WatchRow } from "../../logic/watchrows";
import { setColumn, useColumns, WATCH_COLUMNS, type WatchColumn } from "../../store/columns";
import { removeFromWatch, select, toggleOpen, useWatchList } from "../../store/watchlist";
import { Grip } from "../../ui/Grip";
import { Menu, type MenuItem } from "../../ui/Menu";
import { NoteLine } from "./NoteLine";
import { rowMenu } from "./rowMenu";
import { ValueLine } from "./ValueLine";

const ROW = 24;
const LOOK: Record<WatchColumn, string> = { current: "num", change: "num", type: "c-type", address: "" };

/** The rows: only those in sight exist in the page. The grid holds the focus, the selected row is its active descendant. */
export function WatchGrid({ rows }: { rows: readonly WatchRow[] }) {
  const scroll = useRef<HTMLDivElement>(null);
  const [menu, setMenu] = useState<{ items: MenuItem[]; at: { x: number; y: number } } | null>(null);
  const selected = useWatchList((list) => list.selected);
  const columns = useColumnStyle();
  const virtual = useVirtualizer({
    count: rows.length,
    getScrollElement: () => scroll.current,
    estimateSize: () => ROW,
    overscan: 8,
    // The head sticks to the top of the same scroller.
    scrollMargin: ROW,
    scrollPaddingStart: ROW,
    getItemKey: (index) => `${rows[index]?.kind}:${rows[index]?.root}:${rows[index]?.path}`,
  });
  const now = rows.findIndex((row) => row.kind === "value" && row.path === selected);

  function step(by: number): void {
    for (let i = now + by; i >= 0 && i < rows.length; i += Math.sign(by)) {
      const row = rows[i];
      if (row?.kind !== "value") continue;
      select(row.path);
      virtual.scrollToIndex(i);
      return;
    }
  }

  function onKeyDown(event: KeyboardEvent<HTMLDivElement>): void {
    if ((event.target as HTMLElement).matches("input, .grip")) return;
    const row = rows[now] as ValueRow | undefined;
    switch (event.key) {
      case "ArrowDown":
        step(1);
        break;
      case "ArrowUp":
        step(-1);
        break;
      case "ArrowRight":
        if (row && !row.open && row.symbol?.expandable) void toggleOpen(row.path);
        break;
      case "ArrowLeft":
        if (row?.open) void toggleOpen(row.path);
        break;
      case "Enter":
        event.currentTarget.querySelector<HTMLElement>(".gr.on input")?.focus();
        break;
      case "Delete":
        if (row) removeFromWatch(row.root);
        break;
      case "ContextMenu":
        if (row) openMenu(row, event.currentTarget.querySelector(".gr.on") ?? event.currentTarget);
        break;
      default:
        return;
    }
    event.preventDefault();
  }

  function openMenu(row: ValueRow, anchor: Element): void {
    const { left, bottom } = anchor.getBoundingClientRect();
    setMenu({ items: rowMenu(row), at: { x: left + 40, y: bottom } });
  }

  return (
    <div
      ref={scroll}
      className="grid wt scroll"
      role="treegrid"
      aria-label={t("watch.table")}
      style={columns}
      aria-rowcount={rows.length + 1}
      aria-activedescendant={now >= 0 ? `watch-${now}` : undefined}
      tabIndex={0}
      onKeyDown={onKeyDown}
      onFocus={(event) => {
        // A click brings the focus, too, and the rows must not move away below the pointer.
        if (now < 0 && event.currentTarget.matches(":focus-visible")) step(1);
      }}
    >
      <div className="gr h" role="row" aria-rowindex={1}>
        <span className="gut" role="columnheader" aria-label={t("force.column")} />
        <span role="columnheader" className="first">
          {t("watch.target")}
        </span>
        {WATCH_COLUMNS.map((column) => (
          <span key={column} role="columnheader" className={LOOK[column]}>
            {t(`watch.${column}`)}
            <Grip
              label={t("watch.width", { column: t(`watch.${column}`) })}
              onWidth={(width) => setColumn(column, width)}
            />
          </span>
        ))}
        <span role="columnheader" aria-label={t("watch.remove")} />
      </div>
      <div className="virtual" role="rowgroup" style={{ height: virtual.getTotalSize() }}>
        {virtual.getVirtualItems().map((item) => {
          const row = rows[item.index];
          if (!row) return null;
          const place = { transform: `translateY(${item.start - ROW}px)`, "--lv": row.level };
          return row.kind === "note" ? (
            <NoteLine key={item.key} row={row} style={place} index={item.index} />
          ) : (
            <ValueLine
              key={item.key}
              row={row}
              style={place}
              index={item.index}
              selected={row.path === selected}
              onMenu={(at) => setMenu({ items: rowMenu(row), at })}
            />
          );
        })}
      </div>
      {menu && <Menu label={t("menu.label")} items={menu.items} at={menu.at} onClose={() => setMenu(null)} />}
    </div>
  );
}

/** The dragged widths as custom properties; a column without one keeps what the style sheet says. */
function useColumnStyle(): CSSProperties {
  const widths = useColumns();
  const px = (width: number | undefined) => (width === undefined ? undefined : `${width}px`);
  return {
    "--c-current": px(widths.current),
    "--c-change": px(widths.change),
    "--c-type": px(widths.type),
    "--c-address": px(widths.address),
  };
}
