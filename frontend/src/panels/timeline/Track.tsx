import { type KeyboardEvent, type PointerEvent, useEffect, useMemo, useRef, useState } from "react";
import { grouped, plcTime } from "../../logic/numbers";
import { pieces, stretches } from "../../logic/stretches";
import { t } from "../../logic/text";
import { neighbour, placeOf, scanAt, stepTo, ticks } from "../../logic/timeline";
import { useCatalogue } from "../../store/catalogue";
import { useForbidden } from "../../store/plc";
import { travel, useTimeline } from "../../store/timeline";
import { Marks } from "./Marks";
import { type RunOnAxis, timeOf } from "./useRun";

/** So close to the right edge one means the live end. */
const LIVE_REACH = 6;

interface Props {
  run: RunOnAxis;
  interval: number;
}

/** The axis with its marks. Click, drag and keys lead to a scan; the right end is live. */
export function Track({ run, interval }: Props) {
  const track = useRef<HTMLDivElement>(null);
  const width = useWidth(track);
  const [hover, setHover] = useState<number | null>(null);
  const dragging = useRef(false);
  const locked = useForbidden("travel") !== null;
  const { axis, whole, position, past } = run;
  const at = (scan: number) => `${placeOf(scan, axis) * 100}%`;

  function scanUnder(event: PointerEvent): number | "live" {
    const { left, width: wide } = track.current?.getBoundingClientRect() ?? { left: 0, width: 1 };
    const x = event.clientX - left;
    return x > wide - LIVE_REACH && axis.to === whole.to ? "live" : scanAt(x / wide, axis);
  }

  function go(target: number | "live"): void {
    if (target === "live") {
      if (past || dragging.current) void travel(null);
    } else void travel(target);
  }

  function onPointerDown(event: PointerEvent<HTMLDivElement>): void {
    if (event.button !== 0 || locked) return;
    event.currentTarget.setPointerCapture(event.pointerId);
    dragging.current = true;
    go(scanUnder(event));
  }

  function onPointerMove(event: PointerEvent<HTMLDivElement>): void {
    const target = scanUnder(event);
    setHover(target === "live" ? whole.to : target);
    if (dragging.current) go(target);
  }

  function onPointerUp(event: PointerEvent<HTMLDivElement>): void {
    if (!dragging.current) return;
    go(scanUnder(event));
    dragging.current = false;
  }

  function onKeyDown(event: KeyboardEvent): void {
    const target = keyTarget(event, position, whole);
    if (target === undefined || locked) return;
    event.preventDefault();
    event.stopPropagation();
    go(target);
  }

  return (
    <div className="tl-track" ref={track}>
      <Ribbon run={run} width={width} />
      <div className="tl-axis" aria-hidden="true">
        {ticks(axis, width).map((scan) => (
          <span key={scan} style={{ left: at(scan) }} className={edgeOf(placeOf(scan, axis) * width, width)}>
            {grouped(scan)}
          </span>
        ))}
      </div>
      {past && position <= axis.to && <span className="tl-after" style={{ left: at(position) }} />}
      <span className="head-line live" style={{ left: at(whole.to) }} hidden={!past || axis.to < whole.to}>
        <span className="l">{t("timeline.live.head", { scan: grouped(whole.to) })}</span>
      </span>
      <span
        className={`head-line ${past ? "past" : "now"}`}
        style={{ left: at(position) }}
        hidden={position < axis.from || position > axis.to}
      >
        <span className={`l ${edgeOf(placeOf(position, axis) * width, width)}`}>{grouped(position)}</span>
      </span>
      <div
        className="tl-hit"
        role="slider"
        tabIndex={0}
        aria-label={t("timeline.label")}
        aria-valuemin={whole.from}
        aria-valuemax={whole.to}
        aria-valuenow={position}
        aria-valuetext={t("timeline.position", {
          scan: grouped(position),
          live: grouped(whole.to),
          time: plcTime(timeOf(position, interval)),
        })}
        aria-disabled={locked}
        onPointerDown={onPointerDown}
        onPointerMove={onPointerMove}
        onPointerUp={onPointerUp}
        onPointerLeave={() => setHover(null)}
        onKeyDown={onKeyDown}
      />
      <Marks axis={axis} whole={whole} width={width} position={position} />
      {hover !== null && hover !== position && (
        <span className={`tl-hover ${edgeOf(placeOf(hover, axis) * width, width)}`} style={{ left: at(hover) }}>
          {t("timeline.hover", { scan: grouped(hover), time: plcTime(timeOf(hover, interval)) })}
        </span>
      )}
    </div>
  );
}

/** Ctrl with an arrow leads from mark to mark. */
function keyTarget(event: KeyboardEvent, position: number, whole: RunOnAxis["whole"]): number | "live" | undefined {
  if (!event.ctrlKey && !event.metaKey) return stepTo(event.key, position, whole);
  const direction = event.key === "ArrowLeft" ? -1 : event.key === "ArrowRight" ? 1 : null;
  return direction === null ? undefined : neighbour(useTimeline.getState().marks, position, direction)?.scan;
}

/** The ribbon: the states there were, what of it is slower to reach, and that something before it is gone. */
function Ribbon({ run, width }: { run: RunOnAxis; width: number }) {
  const { info, marks } = useTimeline();
  const { errors } = useCatalogue();
  const course = useMemo(() => stretches(marks, errors), [marks, errors]);
  const thinned = placeOf(info?.thinned_before ?? 0, run.axis);
  const dropped = (info?.dropped_before ?? 0) > 0 && run.axis.from <= run.whole.from;
  return (
    <div className="tl-state">
      {pieces(course, run.axis, width).map(({ left, width: wide, tone }) => (
        <i key={left} className={tone} style={{ left, width: wide }} />
      ))}
      {info && info.thinned_before > run.axis.from && <i className="thinned" style={{ width: `${thinned * 100}%` }} />}
      {dropped && <i className="dropped" />}
    </div>
  );
}

/** Labels at the edges stand beside their line instead of across it, so that they are not cut. */
function edgeOf(x: number, width: number): string {
  if (x < 44) return "atleft";
  return x > width - 44 ? "atright" : "";
}

function useWidth(element: { current: HTMLElement | null }): number {
  const [width, setWidth] = useState(0);
  useEffect(() => {
    if (!element.current) return;
    const observer = new ResizeObserver(([entry]) => setWidth(entry?.contentRect.width ?? 0));
    observer.observe(element.current);
    return () => observer.disconnect();
  }, [element]);
  return width;
}
