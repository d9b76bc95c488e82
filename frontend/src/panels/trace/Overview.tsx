import { type PointerEvent, useLayoutEffect, useRef } from "react";
import { type Layout, within } from "../../logic/trace/plots";
import type { Range, Samples } from "../../logic/trace/samples";
import { look, type Shown, wholeOf } from "../../store/trace/traces";
import { t } from "../../text";
import { colorsOf, drawOverview, prepared } from "./draw";

interface Props {
  shown: Shown;
  samples: Samples | null;
  layout: Layout;
  view: Range;
  theme: string;
  width: number;
}

const EDGE = 12;
const SIGNALS = 3;

/** The whole record, with the visible part marked; the mark can be dragged. */
export function Overview({ shown, samples, layout, view, theme, width }: Props) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const whole = wholeOf({ ...shown, end: Math.max(shown.end, view.to + 1) });
  // biome-ignore lint/correctness/useExhaustiveDependencies: the theme changes the colours
  useLayoutEffect(() => {
    const context = canvas.current && prepared(canvas.current);
    if (!context || !canvas.current || !samples) return;
    const numbers = layout.plots.flatMap(({ lines }) => lines);
    const lines = (numbers.length > 0 ? numbers : layout.lanes).slice(0, SIGNALS);
    drawOverview(context, lines, samples, whole, colorsOf(canvas.current));
  }, [samples, layout, whole.from, whole.to, theme, width]);

  const span = Math.max(1, whole.to - whole.from);
  const inner = Math.max(1, width - 2 * EDGE);
  const left = EDGE + ((Math.max(view.from, whole.from) - whole.from) / span) * inner;
  const right = EDGE + ((Math.min(view.to, whole.to) - whole.from) / span) * inner;

  function onPointerDown(event: PointerEvent<HTMLDivElement>): void {
    const { left: edge } = event.currentTarget.getBoundingClientRect();
    const scanAt = (x: number) => whole.from + ((x - edge - EDGE) / inner) * span;
    const half = (view.to - view.from) / 2;
    const held =
      event.clientX - edge >= left && event.clientX - edge <= right ? scanAt(event.clientX) - view.from : half;
    const move = ({ clientX }: { clientX: number }) => {
      const from = scanAt(clientX) - held;
      look(within({ from, to: from + 2 * half }, whole));
    };
    move(event);
    const onUp = () => {
      removeEventListener("pointermove", move);
      removeEventListener("pointerup", onUp);
    };
    addEventListener("pointermove", move);
    addEventListener("pointerup", onUp);
  }

  return (
    <div className="trover" onPointerDown={onPointerDown}>
      <canvas ref={canvas} role="img" aria-label={t("trace.overview")} />
      <span className="trwindow" style={{ left, width: Math.max(3, right - left) }} />
    </div>
  );
}
