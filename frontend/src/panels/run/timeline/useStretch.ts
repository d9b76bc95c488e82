import { type KeyboardEvent, useRef } from "react";
import { type Axis, neighbour, type ShownMark, stepTo } from "../../../logic/plc/timeline";
import { selectStretch, useTimeline } from "../../../store/plc/timeline";

/** Selecting a stretch: one end stays where it began, the other one moves. */
export function useStretch(position: number, whole: Axis) {
  const ends = useRef<{ held: number; moving: number } | null>(null);

  function now(): { held: number; moving: number } {
    const { selection } = useTimeline.getState();
    const known = ends.current;
    // What was selected elsewhere, or taken away, is not what these ends are of.
    if (selection && known && Math.min(known.held, known.moving) === selection.from) return known;
    if (selection) return { held: selection.from, moving: selection.to };
    return { held: position, moving: position };
  }

  function moveTo(scan: number): void {
    ends.current = { held: now().held, moving: scan };
    selectStretch(ends.current.held, scan);
  }

  return {
    begin: (scan: number) => {
      ends.current = { held: scan, moving: scan };
    },
    /** From where it began, or from the scan that is shown. */
    moveTo,
    drag: (scan: number) => {
      if (ends.current) selectStretch(ends.current.held, scan);
    },
    /** Shift with an arrow; with Ctrl to the next mark. True when the key meant that. */
    key: (event: KeyboardEvent, marks: readonly ShownMark[]): boolean => {
      if (!event.shiftKey || event.key === "Escape") return false;
      const { moving } = now();
      const target = keyTarget(event, moving, whole, marks);
      if (target === undefined) return false;
      moveTo(target === "live" ? whole.to : target);
      return true;
    },
  };
}

/** Where a key leads: Ctrl with an arrow from mark to mark. */
export function keyTarget(
  event: KeyboardEvent,
  from: number,
  whole: Axis,
  marks: readonly ShownMark[],
): number | "live" | undefined {
  if (!event.ctrlKey && !event.metaKey) return stepTo(event.key, from, whole);
  const direction = event.key === "ArrowLeft" ? -1 : event.key === "ArrowRight" ? 1 : null;
  return direction === null ? undefined : neighbour(marks, from, direction)?.scan;
}
