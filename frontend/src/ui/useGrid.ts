import { type Range, useVirtualizer, type VirtualItem } from "@tanstack/react-virtual";
import { type RefObject, useEffect, useRef } from "react";
import { useKeptScroll } from "./useKeptScroll";

/** Height of a row, in pixels; also of the head, unless given. */
export const ROW = 24;

interface Wanted {
  count: number;
  /** The scroll element, if it is needed earlier; its owner then also keeps its scroll position. */
  scroll?: RefObject<HTMLDivElement | null>;
  /** The key of a row, which stays the same while other rows come and go. */
  keyOf?: (index: number) => string | number;
  heightOf?: (index: number) => number;
  /** Height of the sticky head. */
  head?: number;
  overscan?: number;
  rangeOf?: (range: Range) => number[];
}

/** The rows of a grid or a table: only the visible ones are in the page, and a hidden panel keeps its scroll position. */
export function useGrid({ count, keyOf = byIndex, heightOf = rowHeight, head = ROW, overscan = 8, ...more }: Wanted) {
  const own = useRef<HTMLDivElement>(null);
  const { scroll = own, rangeOf } = more;
  useKeptScroll(own);
  const virtual = useVirtualizer({
    count,
    getScrollElement: () => scroll.current,
    estimateSize: heightOf,
    overscan,
    // The sticky head is in the same scroll element.
    scrollMargin: head,
    scrollPaddingStart: head,
    getItemKey: keyOf,
    rangeExtractor: rangeOf,
  });
  const items = virtual.getVirtualItems();

  /** The row that a key moves to; it may be outside the range, -1 is before the first. Undefined: the key does not move. */
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
    /** The properties of the element that contains the rows. */
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

/** Scrolls to the selected row once, wherever it was selected; later changes do not scroll. */
export function useReveal<T>(index: number, selected: T | null, reveal: (index: number) => void): void {
  const last = useRef<T | null>(null);
  useEffect(() => {
    if (index < 0 || last.current === selected) return;
    last.current = selected;
    reveal(index);
  }, [index, selected, reveal]);
}

/** The position for the menu of the selected row, when a key opens it. */
export function belowRow(grid: Element, row = ".gr.on", indent = 40): { x: number; y: number } {
  const { left, bottom } = (grid.querySelector(row) ?? grid).getBoundingClientRect();
  return { x: left + indent, y: bottom };
}
