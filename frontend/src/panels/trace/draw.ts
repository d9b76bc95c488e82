/** Drawing on canvases: colours from the theme, lanes of BOOLs, the overview of the whole record. */
import { type Line, padded } from "../../logic/trace/plots";
import { bounds, perPixel, type Range, type Samples } from "../../logic/trace/samples";

/** Room for the texts of an axis (`AXIS_CHARACTERS`). */
export const LEFT = 76;
export const RIGHT = 112;
export const LANE = 28;

export interface Colors {
  series: readonly string[];
  text: string;
  muted: string;
  faint: string;
  grid: string;
  seam: string;
  fill: string;
  panel: string;
  accent: string;
  font: string;
}

export function colorsOf(element: Element): Colors {
  const style = getComputedStyle(element);
  const of = (name: string) => style.getPropertyValue(name).trim();
  return {
    series: ["--text-muted", ...[1, 2, 3, 4, 5, 6].map((n) => `--series-${n}`)].map(of),
    text: of("--text"),
    muted: of("--text-muted"),
    faint: of("--text-faint"),
    grid: of("--line-soft"),
    seam: of("--line-seam"),
    fill: of("--bg-pressed"),
    panel: of("--bg-panel"),
    accent: of("--accent"),
    font: `${of("--text-xs") || "11px"} ${of("--font-mono") || "monospace"}`,
  };
}

/** A canvas as large as its element, in device pixels; its context counts in those of CSS. */
export function prepared(canvas: HTMLCanvasElement): CanvasRenderingContext2D | null {
  const { clientWidth: width, clientHeight: height } = canvas;
  const ratio = devicePixelRatio || 1;
  if (canvas.width !== Math.round(width * ratio)) canvas.width = Math.round(width * ratio);
  if (canvas.height !== Math.round(height * ratio)) canvas.height = Math.round(height * ratio);
  const context = canvas.getContext("2d");
  context?.setTransform(ratio, 0, 0, ratio, 0, 0);
  context?.clearRect(0, 0, width, height);
  return context;
}

export interface Scale {
  view: Range;
  /** Pixels of the drawing between the gutters. */
  width: number;
}

export const xOf = (scan: number, { view, width }: Scale): number =>
  LEFT + ((scan - view.from) / Math.max(1e-9, view.to - view.from)) * width;

export const scanOf = (x: number, { view, width }: Scale): number =>
  view.from + ((x - LEFT) / Math.max(1, width)) * (view.to - view.from);

/** Lanes of BOOLs, one below the other. */
export function drawLanes(
  context: CanvasRenderingContext2D,
  lanes: readonly Line[],
  samples: Samples,
  scale: Scale,
  colors: Colors,
  xTicks: readonly number[],
  compared: { samples: Samples; columns: readonly number[]; shift: number } | null,
): void {
  const { canvas } = context;
  const height = lanes.length * LANE + 8;
  context.font = colors.font;
  context.lineWidth = 1;
  context.strokeStyle = colors.grid;
  for (const tick of xTicks) line(context, xOf(tick, scale), 0, xOf(tick, scale), height);
  context.strokeStyle = colors.seam;
  line(context, 0, 0.5, canvas.clientWidth, 0.5);
  const drawn = perPixel(
    samples,
    lanes.map(({ index }) => index),
    scale.view,
    scale.width,
  );
  lanes.forEach((lane, at) => {
    const top = at * LANE + 12;
    const ys = drawn.ys[at] ?? [];
    context.save();
    context.beginPath();
    context.rect(LEFT, 0, scale.width, height);
    context.clip();
    steps(context, drawn.xs, ys, scale, top, 0, colors);
    const index = compared?.columns[at] ?? -1;
    if (compared && index >= 0) {
      const moved = { from: scale.view.from - compared.shift, to: scale.view.to - compared.shift };
      const other = perPixel(compared.samples, [index], moved, scale.width);
      context.globalAlpha = 0.7;
      steps(
        context,
        other.xs,
        other.ys[0] ?? [],
        scale,
        top,
        compared.shift,
        { ...colors, fill: "transparent" },
        [4, 3],
      );
    }
    context.restore();
    context.fillStyle = colors.muted;
    context.textAlign = "left";
    context.textBaseline = "middle";
    context.fillText(cut(context, lane.name, RIGHT - 14), LEFT + scale.width + 8, top + 7);
    const last = ys.findLast((value) => value !== null);
    context.fillStyle = colors.faint;
    context.textAlign = "right";
    if (last !== undefined) context.fillText(String(last), LEFT - 8, top + 7);
  });
}

const HIGH = 14;

function steps(
  context: CanvasRenderingContext2D,
  xs: readonly number[],
  ys: readonly (number | null)[],
  scale: Scale,
  top: number,
  shift: number,
  colors: Colors,
  dash: readonly number[] = [],
): void {
  const y = (value: number) => top + (value ? 0 : HIGH);
  context.fillStyle = colors.fill;
  context.strokeStyle = colors.muted;
  context.lineWidth = 1.25;
  context.setLineDash([...dash]);
  context.beginPath();
  let last: number | null = null;
  let high = 0; // where the stretch with TRUE began
  for (let row = 0; row < xs.length; row += 1) {
    const value = ys[row] ?? null;
    const x = xOf((xs[row] as number) + shift, scale);
    if (last && !value) context.fillRect(high, top, Math.max(0.5, x - high), HIGH);
    if (value && !last) high = x;
    if (last !== null) context.lineTo(x, y(last));
    if (value !== null && last === null) context.moveTo(x, y(value));
    else if (value !== null) context.lineTo(x, y(value));
    last = value;
  }
  if (last && xs.length > 0) {
    const end = xOf((xs.at(-1) as number) + shift, scale);
    context.fillRect(high, top, Math.max(0.5, end - high), HIGH);
  }
  context.stroke();
  context.setLineDash([]);
}

/** The overview of the whole record, each signal scaled to its own range. */
export function drawOverview(
  context: CanvasRenderingContext2D,
  lines: readonly Line[],
  samples: Samples,
  whole: Range,
  colors: Colors,
): void {
  const { clientWidth: width, clientHeight: height } = context.canvas;
  const scale: Scale = { view: whole, width: width - 24 };
  const drawn = perPixel(
    samples,
    lines.map(({ index }) => index),
    whole,
    width - 24,
  );
  context.lineWidth = 1.25;
  context.strokeStyle = colors.faint;
  lines.forEach((_, at) => {
    const ys = drawn.ys[at] ?? [];
    const { from, to } = padded(bounds([ys]));
    context.beginPath();
    drawn.xs.forEach((scan, row) => {
      const value = ys[row];
      if (value === null || value === undefined) return;
      context.lineTo(xOf(scan, scale) - LEFT + 12, height - 6 - ((value - from) / (to - from)) * (height - 12));
    });
    context.stroke();
  });
}

export function drawAxis(
  context: CanvasRenderingContext2D,
  xTicks: readonly number[],
  scale: Scale,
  top: number,
  colors: Colors,
  text: (scan: number) => string,
): void {
  context.font = colors.font;
  context.fillStyle = colors.faint;
  context.textAlign = "center";
  context.textBaseline = "alphabetic";
  for (const tick of xTicks) context.fillText(text(tick), xOf(tick, scale), top + 14);
}

function line(context: CanvasRenderingContext2D, x1: number, y1: number, x2: number, y2: number): void {
  context.beginPath();
  context.moveTo(x1, y1);
  context.lineTo(x2, y2);
  context.stroke();
}

/** As much of a text as fits; the beginning is cut off, because the end matters more. */
export function cut(context: CanvasRenderingContext2D, text: string, width: number): string {
  if (context.measureText(text).width <= width) return text;
  let short = text;
  while (short.length > 1 && context.measureText(`…${short}`).width > width) short = short.slice(1);
  return `…${short}`;
}
