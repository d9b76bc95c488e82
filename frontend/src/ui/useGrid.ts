import { type Range, useVirtualizer, type VirtualItem } from "@tanstack/react-virtual";
import { type RefObject, useEffect, useRef } from "react";
import { useKeptScroll } from "./useKeptScroll";

/** Height of a row, in pixels; that of the head, too, unless said. */
export const ROW = 24;

interface Wanted {
  count: number;
  /** What the rows scroll in, where that is needed before; who gives it also keeps its place. */
  scroll?: RefObject<HTMLDivElement | null>;
  /** What a row keeps while others come and go. */
  keyOf?: (index: number) => string | number;
  heightOf?: (index: number) => number;
  /** Height of what sticks to the top of the scroller. */
  head?: number;
  overscan?: number;
  rangeOf?: (range: Range) => number[];
}

/** The rows of a grid or a table: only those in sight exist in the page, and a panel behind another one keeps its place. */
export function useGrid({ count, keyOf = byIndex, heightOf = rowHeight, head = ROW, overscan = 8, ...more }: Wanted) {
  const own = useRef<HTMLDivElement>(null);
  const { scroll = own, rangeOf } = more;
  useKeptScroll(own);
  const virtual = useVirtualizer({
    count,
    getScrollElement: () => scroll.current,
    estimateSize: heightOf,
    overscan,
    // The head sticks to the top of the same scroller.
    scrollMargin: head,
    scrollPaddingStart: head,
    getItemKey: keyOf,
    rangeExtractor: rangeOf,
  });
  const items = virtual.getVirtualItems();

  /** Where a key leads from a row, -1 for none; it may lie outside of the rows. Undefined: the key leads nowhere. */
  function stepOf(key: string, now: number): number | undefined {
    const page = Math.max(1, Math.floor(((scroll.current?.clientHeight ?? 0) - head) / ROW) - 1);
    return {
      ArrowDown: now + 1,
      ArrowUp: now - 1,
      PageDown: now + page,
      PageUp: now - page,
      Home: 0,
      End: count - 1,
    }[key];
  }

  return {
    scroll,
    virtual,
    items,
    from: items[0]?.index ?? 0,
    to: (items.at(-1)?.index ?? -1) + 1,
    /** What holds the rows. */
    body: { className: "virtual", role: "rowgroup", style: { height: virtual.getTotalSize() } },
    topOf: ({ start }: VirtualItem) => start - head,
    isDrawn: (index: number) => items.some((item) => item.index === index),
    stepOf,
    clamped: (index: number) => Math.max(0, Math.min(count - 1, index)),
    reveal: (index: number) => virtual.scrollToIndex(index),
  };
}

const byIndex = (index: number) => index;
const rowHeight = () => ROW;

/** The row that is selected comes into sight once, wherever it was selected; what goes on meanwhile moves nothing. */
export function useReveal<T>(index: number, selected: T | null, reveal: (index: number) => void): void {
  const last = useRef<T | null>(null);
  useEffect(() => {
    if (index < 0 || last.current === selected) return;
    last.current = selected;
    reveal(index);
  }, [index, selected, reveal]);
}

/** Where the menu of the selected row opens by its key. */
export function belowRow(grid: Element, row = ".gr.on", indent = 40): { x: number; y: number } {
  const { left, bottom } = (grid.querySelector(row) ?? grid).getBoundingClientRect();
  return { x: left + indent, y: bottom };
}
