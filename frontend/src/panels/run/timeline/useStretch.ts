import { type KeyboardEvent, useRef } from "react";
import { type Axis, neighbour, type ShownMark, stepTo } from "../../../logic/plc/timeline";
import { selectStretch, useTimeline } from "../../../store/plc/timeline";

/** Selects a stretch: one end is fixed where the selection began, the other one moves. */
export function useStretch(position: number, whole: Axis) {
  const ends = useRef<{ held: number; moving: number } | null>(null);

  function now(): { held: number; moving: number } {
    const { selection } = useTimeline.getState();
    const known = ends.current;
    // If the stretch was selected elsewhere, or cleared, the stored ends do not belong to it.
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
    /** Selects from the fixed end, or from the shown scan. */
    moveTo,
    drag: (scan: number) => {
      if (ends.current) selectStretch(ends.current.held, scan);
    },
    /** Shift with an arrow; with Ctrl to the next mark. True when the key was handled. */
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

/** The scan that a key goes to: Ctrl with an arrow goes from mark to mark. */
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
