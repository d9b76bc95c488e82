/** The rows of a drawing: one for each part, as far as it is in sight, and where it is. */

import { useVirtualizer } from "@tanstack/react-virtual";
import { type CSSProperties, type RefObject, useLayoutEffect, useMemo } from "react";
import type { Heading } from "../../../../logic/graphic/heading";
import { actionOf, type DrawnPart, drawnWith, headOf, heightOf, scaleOf } from "../../../../logic/graphic/sheet";
import { useFit } from "../../../../store/graphic/views";

/** Marks and number, left of a drawing. */
const LEFT = 76;
/** With the margin right of it. */
const BESIDE = LEFT + 18;
const LEAST = 320;
const LEAST_HEAD = 160;

interface Asked {
  drawn: readonly DrawnPart[];
  /** The part with an element that is being named, as it will be. */
  named: { rung: number; text: string } | null;
  /** Of the sheet. */
  width: number;
  sheet: RefObject<HTMLDivElement | null>;
}

interface Row {
  part: DrawnPart;
  scale: number;
  head: Heading;
}

/** How wide drawings are in a sheet; what is said above them has to be read without scrolling. */
export const roomIn = (width: number) => ({
  room: Math.max(LEAST, width - BESIDE),
  headRoom: Math.max(LEAST_HEAD, width - BESIDE),
});

export function useRows({ drawn, named, width, sheet }: Asked) {
  const { room, headRoom } = roomIn(width);
  const fit = useFit();
  const preview = useMemo(() => {
    const part = named && drawn[named.rung];
    return part ? drawnWith(part, named.text, room) : null;
  }, [named, drawn, room]);

  function rowAt(index: number): Row | null {
    const written = drawn[index];
    const part = named?.rung === index && preview ? preview : written;
    if (!written || !part) return null;
    const head = headOf(part, headRoom, actionOf(drawn, written)?.name ?? null);
    return { part, head, scale: fit ? scaleOf(part, room) : 1 };
  }

  function heightAt(index: number): number {
    const row = rowAt(index);
    return row ? heightOf(row.part, row.head.height, row.scale) : 0;
  }

  const virtual = useVirtualizer({
    count: drawn.length,
    getScrollElement: () => sheet.current,
    estimateSize: heightAt,
    overscan: 2,
  });
  // Most edits change no height: then there is nothing to place again.
  // biome-ignore lint/correctness/useExhaustiveDependencies: the heights follow from what is drawn
  const heights = useMemo(() => drawn.map((_, index) => heightAt(index)).join(), [drawn, preview, fit, room, headRoom]);
  // biome-ignore lint/correctness/useExhaustiveDependencies: it measures the heights
  useLayoutEffect(() => virtual.measure(), [heights]);

  return { virtual, preview, rowAt };
}

/**
 * Where a row is. One that is as wide as what is in it is laid out and painted by itself: an edit of it does nothing to the others. A text
 * that cannot be read, and a field with its list, may be larger.
 */
export function placeOf({ part, scale }: Row, start: number, height: number, open: boolean): CSSProperties {
  if (open || !part.readable || !part.drawing) return { top: start, height };
  const width = `max(100%, ${LEFT + Math.ceil(part.drawing.width * scale)}px)`;
  return { top: start, height, width, contain: "layout style" };
}

/** Headings stay in sight while wide drawings are scrolled. `position: sticky` would make a layer of its own of each of them. */
export function keepHeadings(sheet: HTMLElement): void {
  const left = `${sheet.scrollLeft}px`;
  if (sheet.style.getPropertyValue("--scrolled") !== left) sheet.style.setProperty("--scrolled", left);
}
