import {
  type PointerEvent,
  type Ref,
  type RefObject,
  useEffect,
  useImperativeHandle,
  useLayoutEffect,
  useMemo,
  useRef,
  useState,
} from "react";
import "uplot/dist/uPlot.min.css";
import { useShallow } from "zustand/react/shallow";
import { grouped } from "../../logic/format/numbers";
import { type Layout, type Plot, ticks, within, zoomedAt } from "../../logic/trace/plots";
import { nearestRow, type Range, type Samples } from "../../logic/trace/samples";
import { usePrefs } from "../../store/page/prefs";
import {
  type Compared,
  look,
  moveTo,
  type Shown,
  setCursor,
  useTraces,
  viewOf,
  wholeOf,
} from "../../store/trace/traces";
import { t } from "../../text";
import { CursorFlags } from "./CursorFlags";
import { colorsOf, drawAxis, drawLanes, LANE, LEFT, prepared, RIGHT, type Scale, scanOf, xOf } from "./draw";
import { Overview } from "./Overview";
import { PlotDrawing } from "./plot";

interface Props {
  ref: Ref<HTMLDivElement>;
  shown: Shown;
  samples: Samples | null;
  whole: Samples | null;
  layout: Layout;
  compared: Compared | null;
}

const AXIS = 22;
/** In a low panel plots are low, too, so that the lanes below them are in sight. */
const LEAST_PLOT = 44;
/** A press is a drag and not a click once the pointer has moved this far. */
const DRAG = 4;

/** The overview, the plots and lanes with a common scan axis, and the cursors over them. */
export function Graph({ ref, shown, samples, whole, layout, compared }: Props) {
  const element = useRef<HTMLDivElement>(null);
  const size = useSize(element);
  useImperativeHandle(ref, () => element.current as HTMLDivElement);
  const looked = useTraces(useShallow(({ view, follows, a, b }) => ({ view, follows, a, b })));
  const theme = usePrefs((prefs) => prefs.theme);
  const view = viewOf(looked, shown, samples?.end ?? shown.end);
  const width = Math.max(40, size.width - LEFT - RIGHT);
  const scale: Scale = { view, width };
  const lanesHeight = layout.lanes.length > 0 ? layout.lanes.length * LANE + 8 : 0;
  const room = size.height - 40 - lanesHeight - AXIS;
  const plotHeight = Math.max(LEAST_PLOT, Math.floor(room / Math.max(1, layout.plots.length)));
  const { a, b } = looked;
  const cursors = useMemo(() => [a, b].filter((scan): scan is number => scan !== null), [a, b]);
  const { from, to } = view;
  const xTicks = useMemo(() => ticks({ from, to }, Math.max(2, Math.floor(width / 110)), true), [from, to, width]);
  const box = useRef<ShowBox>(null);
  const onPointerDown = useDrag(shown, samples, scale, element, box);
  useWheel(element, shown, scale);

  return (
    <div className="trplot" ref={element}>
      <Overview shown={shown} samples={whole} layout={layout} view={view} theme={theme} width={size.width} />
      <div className="trstack" onPointerDown={onPointerDown}>
        {samples &&
          layout.plots.map((plot) => (
            <PlotArea
              key={`${plot.key} ${plot.lines.map(({ signal }) => signal.text).join()} ${theme}`}
              plot={plot}
              width={size.width}
              height={plotHeight}
              view={view}
              samples={samples}
              xTicks={xTicks}
              cursors={cursors}
              compared={compared}
            />
          ))}
        <Lanes layout={layout} samples={samples} scale={scale} xTicks={xTicks} theme={theme} compared={compared} />
        <Axis scale={scale} xTicks={xTicks} theme={theme} />
        {samples?.scans.length === 0 && <p className="trnone faint">{t("trace.nothing")}</p>}
        {shown.triggered !== null && <TriggerMark x={xOf(shown.triggered, scale)} width={width} />}
        <DragBox ref={box} />
        <CursorFlags shown={shown} samples={samples} scale={scale} />
      </div>
    </div>
  );
}

/** The columns of a record that belong to the drawn signals. */
function comparedWith(compared: Compared | null, lines: readonly { signal: { text: string } }[]) {
  if (compared === null) return null;
  const { record, samples, shift } = compared;
  const columns = lines.map(({ signal }) => record.signals.findIndex(({ text }) => text === signal.text));
  return { samples, shift, columns };
}

type ShowBox = (box: Range | null) => void;

/** The range that is marked during a drag: only this element is drawn again. */
function DragBox({ ref }: { ref: Ref<ShowBox> }) {
  const [box, show] = useState<Range | null>(null);
  useImperativeHandle(ref, () => show, []);
  return box && <span className="trbox" style={{ left: box.from, width: box.to - box.from }} />;
}

function TriggerMark({ x, width }: { x: number; width: number }) {
  if (x < LEFT || x > LEFT + width) return null;
  return <span className="trtrigger" style={{ left: x }} title={t("trace.triggerhere")} />;
}

interface AreaProps {
  plot: Plot;
  width: number;
  height: number;
  view: Range;
  samples: Samples;
  xTicks: readonly number[];
  cursors: readonly number[];
  compared: Compared | null;
}

function PlotArea({ plot, width, height, view, samples, xTicks, cursors, compared }: AreaProps) {
  const element = useRef<HTMLDivElement>(null);
  const drawing = useRef<PlotDrawing | null>(null);
  // The drawing is created once; for different lines or colours, React's key creates a new one.
  // biome-ignore lint/correctness/useExhaustiveDependencies: see above
  useLayoutEffect(() => {
    if (!element.current || width === 0) return;
    const made = new PlotDrawing(element.current, plot, colorsOf(element.current), { width, height });
    drawing.current = made;
    return () => made.destroy();
  }, [width === 0]);
  const { from, to } = view;
  // Once a frame, however often the view changes meanwhile.
  useEffect(() => {
    const beside = comparedWith(compared, plot.lines);
    const frame = requestAnimationFrame(() => {
      drawing.current?.resize(width, height);
      drawing.current?.show({ view: { from, to }, samples, xTicks, cursors, compared: beside });
    });
    return () => cancelAnimationFrame(frame);
  }, [plot, width, height, from, to, samples, xTicks, cursors, compared]);
  return (
    <div
      ref={element}
      className="truplot"
      style={{ height }}
      role="img"
      aria-label={t("trace.plot", { names: plot.lines.map(({ signal }) => signal.text).join(", ") })}
      onDragOver={(event) => event.dataTransfer.types.includes("application/x-trace-signal") && event.preventDefault()}
      onDrop={(event) => {
        const text = event.dataTransfer.getData("application/x-trace-signal");
        if (!text) return;
        event.preventDefault();
        event.stopPropagation();
        moveTo(text, plot.key);
      }}
    />
  );
}

interface LanesProps {
  layout: Layout;
  samples: Samples | null;
  scale: Scale;
  xTicks: readonly number[];
  theme: string;
  compared: Compared | null;
}

/** Lanes of BOOLs. */
function Lanes({ layout: { lanes }, samples, scale, xTicks, theme, compared }: LanesProps) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const height = lanes.length > 0 ? lanes.length * LANE + 8 : 0;
  // biome-ignore lint/correctness/useExhaustiveDependencies: the theme changes the colours
  useLayoutEffect(() => {
    const context = canvas.current && prepared(canvas.current);
    if (!context || !canvas.current) return;
    const colors = colorsOf(canvas.current);
    const beside = comparedWith(compared, lanes);
    if (samples && lanes.length > 0) drawLanes(context, lanes, samples, scale, colors, xTicks, beside);
  }, [lanes, samples, scale.view.from, scale.view.to, scale.width, theme, compared]);
  return (
    <canvas
      ref={canvas}
      className="trlanes"
      style={{ height }}
      role="img"
      aria-label={t("trace.plot", { names: lanes.map(({ signal }) => signal.text).join(", ") })}
    />
  );
}

/** The scan axis of all plots: it stays in sight while they are scrolled. */
function Axis({ scale, xTicks, theme }: Pick<LanesProps, "scale" | "xTicks" | "theme">) {
  const canvas = useRef<HTMLCanvasElement>(null);
  // biome-ignore lint/correctness/useExhaustiveDependencies: the theme changes the colours
  useLayoutEffect(() => {
    const context = canvas.current && prepared(canvas.current);
    if (context && canvas.current) drawAxis(context, xTicks, scale, 0, colorsOf(canvas.current), grouped);
  }, [xTicks, scale.view.from, scale.view.to, scale.width, theme]);
  return <canvas ref={canvas} className="traxis" style={{ height: AXIS }} />;
}

function useSize(element: { current: HTMLElement | null }): { width: number; height: number } {
  const [size, setSize] = useState({ width: 0, height: 0 });
  useEffect(() => {
    if (!element.current) return;
    const observer = new ResizeObserver(([entry]) => {
      if (entry) setSize({ width: Math.floor(entry.contentRect.width), height: Math.floor(entry.contentRect.height) });
    });
    observer.observe(element.current);
    return () => observer.disconnect();
  }, [element]);
  return size;
}

/** Wheel: zooms at the pointer; with Shift, or sideways: scrolls. */
function useWheel(element: { current: HTMLElement | null }, shown: Shown, scale: Scale): void {
  const now = useRef({ shown, scale });
  now.current = { shown, scale };
  useEffect(() => {
    const target = element.current;
    if (!target) return;
    const onWheel = (event: WheelEvent) => {
      const { shown, scale } = now.current;
      const whole = wholeOf(shown);
      const along = event.shiftKey || Math.abs(event.deltaX) > Math.abs(event.deltaY);
      if (!along && !event.ctrlKey && target.scrollHeight > target.clientHeight + 1 && !inside(event, target)) return;
      event.preventDefault();
      const { from, to } = scale.view;
      if (along) {
        const by = ((event.deltaX || event.deltaY) / scale.width) * (to - from);
        look(within({ from: from + by, to: to + by }, whole));
        return;
      }
      const held = scanOf(event.clientX - target.getBoundingClientRect().left, scale);
      look(zoomedAt(scale.view, whole, 1.2 ** (event.deltaY / 60), Math.max(from, Math.min(to, held))));
    };
    target.addEventListener("wheel", onWheel, { passive: false });
    return () => target.removeEventListener("wheel", onWheel);
  }, [element]);
}

/** Between the gutters the wheel zooms, even if the panel could be scrolled. */
function inside(event: WheelEvent, target: HTMLElement): boolean {
  const { left, width } = target.getBoundingClientRect();
  return event.clientX - left > LEFT && event.clientX - left < width - RIGHT;
}

/** Click: sets a cursor. Drag: zooms to the marked range. Drag with Shift or the middle button: scrolls. */
function useDrag(
  shown: Shown,
  samples: Samples | null,
  scale: Scale,
  element: { current: HTMLElement | null },
  box: RefObject<ShowBox | null>,
) {
  const setBox: ShowBox = (marked) => box.current?.(marked);

  function onPointerDown(event: PointerEvent): void {
    const target = element.current;
    if (!target || event.button > 1 || (event.target as Element).closest("button")) return;
    const left = target.getBoundingClientRect().left;
    const start = event.clientX;
    const along = event.shiftKey || event.button === 1;
    const begin = scale;
    const inX = (x: number) => Math.max(LEFT, Math.min(LEFT + begin.width, x - left));
    let moved = false;
    const onMove = (move: globalThis.PointerEvent) => {
      moved ||= Math.abs(move.clientX - start) > DRAG;
      if (!moved) return;
      if (along) {
        const by = ((start - move.clientX) / begin.width) * (begin.view.to - begin.view.from);
        look(within({ from: begin.view.from + by, to: begin.view.to + by }, wholeOf(shown)));
      } else setBox({ from: Math.min(inX(start), inX(move.clientX)), to: Math.max(inX(start), inX(move.clientX)) });
    };
    const onUp = (up: globalThis.PointerEvent) => {
      removeEventListener("pointermove", onMove);
      removeEventListener("pointerup", onUp);
      removeEventListener("pointercancel", onUp);
      setBox(null);
      if (!moved) click(scanOf(start - left, begin));
      else if (!along && up.type === "pointerup") {
        const ends = [scanOf(inX(start), begin), scanOf(inX(up.clientX), begin)];
        look({ from: Math.min(...ends), to: Math.max(...ends) });
      }
    };
    addEventListener("pointermove", onMove);
    addEventListener("pointerup", onUp);
    addEventListener("pointercancel", onUp);
  }

  /** Sets the first cursor, then the second, then moves the nearer one. */
  function click(scan: number): void {
    if (!samples || scan < scale.view.from || scan > scale.view.to) return;
    const at = samples.scans[nearestRow(samples, scan)];
    if (at === undefined) return;
    const { a, b } = useTraces.getState();
    const nearer = a !== null && b !== null && Math.abs(b - at) < Math.abs(a - at) ? "b" : "a";
    setCursor(a === null ? "a" : b === null ? "b" : nearer, at);
  }

  return onPointerDown;
}
