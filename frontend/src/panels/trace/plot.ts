/** One plot of numbers with uPlot. Samples are decimated to pixels first; names at the ends of lines and dots at cursors are drawn afterwards. */
import uPlot from "uplot";
import { axisMarks, type Mark } from "../../logic/trace/axis";
import { type Plot, padded } from "../../logic/trace/plots";
import { bounds, type Drawn, perPixel, type Range, rowAt, type Samples } from "../../logic/trace/samples";
import { type Colors, cut, LEFT, RIGHT } from "./draw";

/** From this height on a plot has a line above its curves for its title; the names at the ends of a lower one are the whole ones. */
const TITLED = 64;
const TITLE = 18;

interface PlotView {
  samples: Samples;
  view: Range;
  xTicks: readonly number[];
  cursors: readonly number[];
  compared: { samples: Samples; columns: readonly number[]; shift: number } | null;
}

/** The drawing of one plot in an element, which it fills. */
export class PlotDrawing {
  private readonly chart: uPlot;
  private now: PlotView | null = null;
  private y: Range = { from: 0, to: 1 };
  private marks: readonly Mark[] = [];
  private other: { drawn: Drawn; shift: number } | null = null;

  constructor(
    element: HTMLElement,
    private readonly plot: Plot,
    private readonly colors: Colors,
    size: { width: number; height: number },
  ) {
    this.chart = new uPlot(this.options(size), [[], ...plot.lines.map(() => [])] as uPlot.AlignedData, element);
  }

  destroy(): void {
    this.chart.destroy();
  }

  resize(width: number, height: number): void {
    if (this.chart.width !== width || this.chart.height !== height) this.chart.setSize({ width, height });
  }

  show(view: PlotView): void {
    this.now = view;
    const pixels = Math.max(50, this.chart.width - LEFT - RIGHT);
    const drawn = perPixel(
      view.samples,
      this.plot.lines.map(({ index }) => index),
      view.view,
      pixels,
    );
    const { compared } = view;
    this.other = null;
    if (compared) {
      const moved = { from: view.view.from - compared.shift, to: view.view.to - compared.shift };
      this.other = { drawn: perPixel(compared.samples, compared.columns, moved, pixels), shift: compared.shift };
    }
    this.y = padded(bounds([...drawn.ys, ...(this.other?.drawn.ys ?? [])]), this.plot.unit);
    this.chart.batch(() => {
      this.chart.setData([drawn.xs, ...drawn.ys] as uPlot.AlignedData, false);
      this.chart.setScale("x", { min: view.view.from, max: view.view.to });
      this.chart.setScale("y", { min: this.y.from, max: this.y.to });
    });
  }

  private options(size: { width: number; height: number }): uPlot.Options {
    const { colors, plot } = this;
    const stepped = uPlot.paths.stepped?.({ align: 1 });
    return {
      ...size,
      padding: [(chart) => (chart.height < TITLED ? 6 : TITLE), RIGHT, 6, 0],
      cursor: { show: false },
      legend: { show: false },
      pxAlign: 0,
      scales: { x: { time: false, auto: false }, y: { auto: false } },
      axes: [
        {
          show: true,
          size: 0,
          splits: () => [...(this.now?.xTicks ?? [])],
          values: (_, splits) => splits.map(() => ""),
          grid: { stroke: colors.grid, width: 1 },
          ticks: { show: false },
        },
        {
          size: LEFT,
          gap: 8,
          stroke: colors.faint,
          font: colors.font,
          splits: () => {
            this.marks = axisMarks(this.y, Math.max(2, Math.floor(this.chart.height / 44)), plot.unit);
            return this.marks.map(({ at }) => at);
          },
          values: () => this.marks.map(({ text }) => text),
          grid: { stroke: colors.grid, width: 1 },
          ticks: { show: false },
        },
      ],
      series: [
        {},
        ...plot.lines.map(
          (one): uPlot.Series => ({
            stroke: colors.series[one.color] ?? colors.text,
            width: 1.5,
            dash: [...one.dash],
            points: { show: false },
            ...(one.steps && stepped ? { paths: stepped } : {}),
          }),
        ),
      ],
      hooks: { draw: [() => this.drawRest()] },
    };
  }

  /** Drawn after uPlot has drawn its lines: the record to compare with, names, dots, the title. In device pixels. */
  private drawRest(): void {
    const { ctx, bbox } = this.chart;
    const ratio = devicePixelRatio || 1;
    const { colors, plot, now } = this;
    if (!now) return;
    ctx.save();
    this.compare(ctx);
    ctx.font = scaled(colors.font, ratio);
    ctx.textBaseline = "middle";
    ctx.textAlign = "left";
    ctx.fillStyle = colors.faint;
    const titled = this.chart.height >= TITLED;
    if (titled) ctx.fillText(plot.title, bbox.left, bbox.top - (TITLE / 2) * ratio);
    let free = Number.NEGATIVE_INFINITY;
    const ends = plot.lines
      .map((line) => ({ line, y: this.endOf(line.index, now) }))
      .filter((end): end is { line: (typeof plot.lines)[number]; y: number } => end.y !== null)
      .sort((one, other) => one.y - other.y);
    for (const { line, y } of ends) {
      const at = Math.max(Math.min(Math.max(y, bbox.top + 6 * ratio), bbox.top + bbox.height), free);
      free = at + 13 * ratio;
      ctx.fillStyle = colors.series[line.color] ?? colors.text;
      ctx.fillText(
        cut(ctx, titled ? line.name : line.signal.text, (RIGHT - 14) * ratio),
        bbox.left + bbox.width + 8 * ratio,
        at,
      );
    }
    for (const scan of now.cursors) this.dots(ctx, scan, now, ratio);
    ctx.restore();
  }

  private endOf(index: number, { samples, view }: PlotView): number | null {
    for (let row = rowAt(samples, view.to); row >= 0; row -= 1) {
      const value = samples.columns[index]?.[row];
      if ((samples.scans[row] ?? 0) < view.from) return null;
      if (value !== undefined && !Number.isNaN(value)) return this.chart.valToPos(value, "y", true);
    }
    return null;
  }

  private dots(ctx: CanvasRenderingContext2D, scan: number, { samples, view }: PlotView, ratio: number): void {
    if (scan < view.from || scan > view.to || samples.decimated) return;
    const row = rowAt(samples, scan);
    for (const line of this.plot.lines) {
      const value = samples.columns[line.index]?.[row];
      if (row < 0 || value === undefined || Number.isNaN(value)) continue;
      ctx.beginPath();
      ctx.arc(this.chart.valToPos(scan, "x", true), this.chart.valToPos(value, "y", true), 3.5 * ratio, 0, 2 * Math.PI);
      ctx.fillStyle = this.colors.series[line.color] ?? this.colors.text;
      ctx.fill();
      ctx.lineWidth = 1.5 * ratio;
      ctx.strokeStyle = this.colors.panel;
      ctx.stroke();
    }
  }

  private compare(ctx: CanvasRenderingContext2D): void {
    if (!this.other) return;
    const { bbox } = this.chart;
    const { drawn, shift } = this.other;
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    ctx.setLineDash([6, 4]);
    ctx.globalAlpha = 0.75;
    ctx.lineWidth = 1.5 * (devicePixelRatio || 1);
    this.plot.lines.forEach((line, at) => {
      ctx.strokeStyle = this.colors.series[line.color] ?? this.colors.text;
      ctx.beginPath();
      let broken = true;
      let last = 0;
      drawn.xs.forEach((scan, row) => {
        const value = drawn.ys[at]?.[row] ?? null;
        if (value === null) {
          broken = true;
          return;
        }
        const x = this.chart.valToPos(scan + shift, "x", true);
        const y = this.chart.valToPos(value, "y", true);
        if (broken) ctx.moveTo(x, y);
        else {
          if (line.steps) ctx.lineTo(x, last);
          ctx.lineTo(x, y);
        }
        broken = false;
        last = y;
      });
      ctx.stroke();
    });
    ctx.restore();
  }
}

const scaled = (font: string, ratio: number) =>
  font.replace(/([\d.]+)px/, (_, size: string) => `${Number(size) * ratio}px`);
