import { useEffect, useState } from "react";
import { type Axis, including } from "../../../logic/plc/timeline";
import { bindClock, readClock } from "../../../store/plc/clock";
import { usePlc } from "../../../store/plc/plc";
import { useTimeline } from "../../../store/plc/timeline";

/** Thousands of scans come each second: the axis grows with them, but is drawn only a few times a second. */
const REDRAW = 250;

export interface RunOnAxis {
  /** All scans that can be reached. */
  whole: Axis;
  /** The visible part of them. */
  axis: Axis;
  /** The shown scan, or the scan that the page is going to. */
  position: number;
  past: boolean;
}

/** The run as the timeline draws it; null while there is none. */
export function useRun(): RunOnAxis | null {
  const clock = useSlowClock();
  const { info, view, follows, aim } = useTimeline();
  const past = usePlc((plc) => plc.state?.past ?? null);
  const shown = usePlc((plc) => plc.state?.scan ?? 0);
  if (!info) return null;
  const whole = { from: info.first_scan, to: Math.max(info.first_scan, past?.live_scan ?? clock) };
  const position = aim ?? (past ? shown : whole.to);
  return { whole, axis: axisOf(view, follows, whole, position), position, past: past !== null };
}

function axisOf(view: Axis | null, follows: boolean, whole: Axis, position: number): Axis {
  // A view from before a new run may be wider than the new run.
  if (view === null || view.to - view.from >= whole.to - whole.from) return whole;
  if (!follows) return view;
  return including({ from: whole.to - (view.to - view.from), to: whole.to }, whole, position);
}

function useSlowClock(): number {
  const [scan, setScan] = useState(() => readClock().scan);
  useEffect(() => {
    let timer: ReturnType<typeof setTimeout> | undefined;
    const unbind = bindClock(() => {
      timer ??= setTimeout(() => {
        timer = undefined;
        setScan(readClock().scan);
      }, REDRAW);
    });
    return () => {
      unbind();
      clearTimeout(timer);
    };
  }, []);
  return scan;
}

/** PLC time at a scan: the scan number times the task interval. */
export function timeOf(scan: number, intervalNs: number): number {
  const clock = readClock();
  return Math.max(0, clock.timeNs + (scan - clock.scan) * intervalNs);
}

/** The scan that begins at a PLC time, or the nearest one. */
export function scanOfTime(timeNs: number, intervalNs: number): number {
  const clock = readClock();
  return clock.scan + Math.round((timeNs - clock.timeNs) / Math.max(1, intervalNs));
}
