import { type KeyboardEvent, type MouseEvent, type PointerEvent, useEffect, useMemo, useRef, useState } from "react";
import { grouped, plcTime } from "../../../logic/format/numbers";
import { pieces, stretches } from "../../../logic/plc/stretches";
import { placeOf, scanAt, spanOn, ticks } from "../../../logic/plc/timeline";
import { useCatalogue } from "../../../store/errors/catalogue";
import { shownComparison, useComparisons } from "../../../store/past/comparisons";
import { useAllMarks } from "../../../store/past/differences";
import { useForbidden } from "../../../store/plc/plc";
import { selectStretch, travel, useTimeline } from "../../../store/plc/timeline";
import { t } from "../../../text";
import { useMenu } from "../../../ui/Menu";
import { Marks } from "./Marks";
import { pointMenu, stretchMenu } from "./menus";
import { type RunOnAxis, timeOf } from "./useRun";
import { keyTarget, useStretch } from "./useStretch";

/** A click this close to the right edge means the live end. */
const LIVE_REACH = 6;

interface Props {
  run: RunOnAxis;
  interval: number;
}

/** The axis with its marks. Click, drag and keys go to a scan; the right end is live. */
export function Track({ run, interval }: Props) {
  const track = useRef<HTMLDivElement>(null);
  const width = useWidth(track);
  const [hover, setHover] = useState<number | null>(null);
  const dragging = useRef<"travel" | "select" | null>(null);
  const { open, menu } = useMenu(t("timeline.label"));
  const locked = useForbidden("travel") !== null;
  const marks = useAllMarks();
  const selection = useTimeline((timeline) => timeline.selection);
  const { axis, whole, position, past } = run;
  const stretch = useStretch(position, whole);
  const at = (scan: number) => `${placeOf(scan, axis) * 100}%`;

  function scanUnder(event: MouseEvent): number | "live" {
    const { left, width: wide } = track.current?.getBoundingClientRect() ?? { left: 0, width: 1 };
    const x = event.clientX - left;
    return x > wide - LIVE_REACH && axis.to === whole.to ? "live" : scanAt(x / wide, axis);
  }

  const numberOf = (target: number | "live") => (target === "live" ? whole.to : target);

  function go(target: number | "live"): void {
    if (target === "live") {
      if (past || dragging.current) void travel(null);
    } else void travel(target);
  }

  function onPointerDown(event: PointerEvent<HTMLDivElement>): void {
    if (event.button !== 0 || (locked && !event.shiftKey)) return;
    event.currentTarget.setPointerCapture(event.pointerId);
    const target = scanUnder(event);
    dragging.current = event.shiftKey ? "select" : "travel";
    if (event.shiftKey) stretch.begin(numberOf(target));
    else {
      selectStretch(null);
      go(target);
    }
  }

  function onPointerMove(event: PointerEvent<HTMLDivElement>): void {
    const target = scanUnder(event);
    setHover(numberOf(target));
    if (dragging.current === "travel") go(target);
    if (dragging.current === "select") stretch.drag(numberOf(target));
  }

  function onPointerUp(event: PointerEvent<HTMLDivElement>): void {
    const { current } = dragging;
    if (current === null) return;
    if (current === "travel") go(scanUnder(event));
    dragging.current = null;
    if (current === "select") openMenu(numberOf(scanUnder(event)), { x: event.clientX, y: event.clientY });
  }

  /** The menu of the selected stretch, else of a scan. */
  function openMenu(scan: number, at: { x: number; y: number }): void {
    const { selection: chosen } = useTimeline.getState();
    const inside = chosen && scan >= chosen.from && scan <= chosen.to;
    const here = marks.filter((mark) => mark.scan === scan);
    const items = inside ? stretchMenu(chosen, whole) : pointMenu({ scan, marks: here, position });
    open(items, at);
  }

  /** By keyboard: at the end of the selected stretch, else at the playhead. */
  function openMenuByKey(): void {
    const scan = useTimeline.getState().selection?.to ?? position;
    const { left, top, width: wide } = track.current?.getBoundingClientRect() ?? { left: 0, top: 0, width: 1 };
    openMenu(scan, { x: left + placeOf(scan, axis) * wide, y: top });
  }

  function onContextMenu(event: MouseEvent): void {
    event.preventDefault();
    if (event.button === 2) openMenu(numberOf(scanUnder(event)), { x: event.clientX, y: event.clientY });
    else openMenuByKey();
  }

  function onKeyDown(event: KeyboardEvent): void {
    if (!takeKey(event)) return;
    event.preventDefault();
    event.stopPropagation();
  }

  function takeKey(event: KeyboardEvent): boolean {
    if (stretch.key(event, marks)) return true;
    if (event.key === "Escape" && selection) selectStretch(null);
    else if (event.key === "Enter" || event.key === "ContextMenu") openMenuByKey();
    else {
      const target = keyTarget(event, position, whole, marks);
      if (target === undefined || locked) return false;
      go(target);
    }
    return true;
  }

  return (
    <div className="tl-track" ref={track}>
      <Selected run={run} />
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
        {/* If the two labels would overlap, the live one is hidden. */}
        <span className="l" hidden={(placeOf(whole.to, axis) - placeOf(position, axis)) * width < 1.5 * LABEL}>
          {t("timeline.live.head", { scan: grouped(whole.to) })}
        </span>
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
        onContextMenu={onContextMenu}
        onKeyDown={onKeyDown}
      />
      <Marks marks={marks} axis={axis} whole={whole} width={width} position={position} />
      {menu}
      {hover !== null && hover !== position && (
        <span className={`tl-hover ${edgeOf(placeOf(hover, axis) * width, width)}`} style={{ left: at(hover) }}>
          {t("timeline.hover", { scan: grouped(hover), time: plcTime(timeOf(hover, interval)) })}
        </span>
      )}
    </div>
  );
}

/** The stretch that is selected. */
function Selected({ run }: { run: RunOnAxis }) {
  const selection = useTimeline((timeline) => timeline.selection);
  const span = selection && spanOn(selection, run.axis);
  if (!span) return null;
  return <span className="tl-sel" style={{ left: `${span.left * 100}%`, width: `${span.width * 100}%` }} />;
}

/** Where the run differs from the run that it was compared with. */
function Differing({ run }: { run: RunOnAxis }) {
  const stretches = useComparisons((comparisons) => shownComparison(comparisons)?.result?.marks);
  return stretches?.map(([from, to]) => {
    const span = spanOn({ from, to }, run.axis);
    return (
      span && (
        <i
          key={from}
          className="differs"
          style={{ left: `${span.left * 100}%`, width: `max(2px, ${span.width * 100}%)` }}
        />
      )
    );
  });
}

/** Scans that a damaged run file lost. */
function Lost({ run }: { run: RunOnAxis }) {
  const lost = useTimeline((timeline) => timeline.info?.lost);
  return lost?.map(({ first, until }) => {
    const span = spanOn({ from: first, to: until }, run.axis);
    return (
      span && (
        <i
          key={first}
          className="lost"
          title={t("timeline.lost", { first: grouped(first), last: grouped(Math.max(first, until - 1)) })}
          style={{ left: `${span.left * 100}%`, width: `max(3px, ${span.width * 100}%)` }}
        />
      )
    );
  });
}

/** The ribbon: the states of the PLC, which part of the run is slower to reach, and that the part before it is gone. */
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
      <Lost run={run} />
      <Differing run={run} />
    </div>
  );
}

/** The approximate width of a scan number, in pixels. */
const LABEL = 44;

/** Labels at the edges are beside their line instead of centred on it, so that they are not cut off. */
function edgeOf(x: number, width: number): string {
  if (x < LABEL) return "atleft";
  return x > width - LABEL ? "atright" : "";
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
