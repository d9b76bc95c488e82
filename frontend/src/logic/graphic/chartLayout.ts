/**
 * The drawing of a chart: follows from its text alone. A sequence goes down; the first one of several beside each other keeps the
 * axis. A transition to a step above is an arrow with the name of the step.
 */

import { type Chart, type ChartAction, type ChartStep, type ChartTransition, inTestOrder, keyOf } from "./chart";
import { type Flow, flowOf, inDrawingOrder, meetingOf } from "./chartFlow";
import { hasNumbers } from "./condition";
import type { Place } from "./ladderLayout";
import { widthOf } from "./measure";

export type ChartElement = ChartStep | ChartTransition | ChartAction;

export interface ChartDrawn {
  element: ChartElement;
  place: Place;
  /** The left end, and the middle of the rectangle that belongs to it. */
  x: number;
  y: number;
  width: number;
  up: number;
  down: number;
  /** The line that it is on. */
  axis: number;
  /** Of a transition beside others: its number in the order in which they are tested. */
  order: number | null;
  /** Of an action: how wide its qualifier is. */
  cell: number;
}

interface Line {
  points: readonly (readonly [number, number])[];
  /** A simultaneous divergence or convergence. */
  double: boolean;
}

interface Arrow {
  x: number;
  y: number;
  /** The step that it leads to, or the steps that it waits for. */
  name: string;
  /** No step has this name. */
  unknown: boolean;
}

export interface ChartDrawing {
  width: number;
  height: number;
  elements: readonly ChartDrawn[];
  lines: readonly Line[];
  arrows: readonly Arrow[];
}

export const ACTION_ROW = 22;
const STEP_HEIGHT = 40;
const STEP_WIDTH = 112;
const LEAD = 14;
const BAR = 16;
const GAP = 32;
const ARROW = 26;
const LONGEST = 52;
const VALUES = 96;
const MARGIN = 20;

/** What is written of a condition; the whole of it is its title. */
export const shortened = (condition: string) =>
  condition.length > LONGEST ? `${condition.slice(0, LONGEST - 1)}…` : condition;

export const qualifierText = ({ qualifier, duration }: ChartAction) =>
  duration === "" ? qualifier : `${qualifier} ${duration}`;

/** A part of the drawing, around the line that comes in at 0, 0. */
interface Block {
  left: number;
  right: number;
  bottom: number;
  /** Paths that end here, and go on where they meet others. */
  ends: readonly { key: string; x: number; y: number }[];
  elements: readonly ChartDrawn[];
  lines: readonly Line[];
  arrows: readonly Arrow[];
  /** Blocks in it, each moved by so much: nothing is copied until the whole is there. */
  inner: readonly { block: Block; dx: number; dy: number }[];
}

const EMPTY: Block = { left: 0, right: 0, bottom: 0, ends: [], elements: [], lines: [], arrows: [], inner: [] };

const moved = (block: Block, dx: number, dy: number): Block => ({
  ...EMPTY,
  left: block.left + dx,
  right: block.right + dx,
  bottom: block.bottom + dy,
  ends: block.ends.map((each) => ({ ...each, x: each.x + dx, y: each.y + dy })),
  inner: [{ block, dx, dy }],
});

const together = (blocks: readonly Block[]): Block => ({
  ...EMPTY,
  left: Math.min(0, ...blocks.map(({ left }) => left)),
  right: Math.max(0, ...blocks.map(({ right }) => right)),
  bottom: Math.max(0, ...blocks.map(({ bottom }) => bottom)),
  ends: blocks.flatMap(({ ends }) => ends),
  inner: blocks.map((block) => ({ block, dx: 0, dy: 0 })),
});

/** All that is in a block, at its place. */
function flattened(whole: Block): Pick<Block, "elements" | "lines" | "arrows"> {
  const elements: ChartDrawn[] = [];
  const lines: Line[] = [];
  const arrows: Arrow[] = [];
  const open = [{ block: whole, dx: 0, dy: 0 }];
  for (let next = open.pop(); next; next = open.pop()) {
    const { block, dx, dy } = next;
    const by = <T extends { x: number; y: number }>(each: T): T => ({ ...each, x: each.x + dx, y: each.y + dy });
    elements.push(...block.elements.map((each) => ({ ...by(each), axis: each.axis + dx })));
    lines.push(
      ...block.lines.map((line) => ({ ...line, points: line.points.map(([x, y]) => [x + dx, y + dy] as const) })),
    );
    arrows.push(...block.arrows.map(by));
    open.push(...block.inner.map((each) => ({ block: each.block, dx: each.dx + dx, dy: each.dy + dy })));
  }
  return { elements, lines, arrows };
}

const line = (x: number, from: number, to: number): Line => ({
  points: [
    [x, from],
    [x, to],
  ],
  double: false,
});
const across = (from: number, to: number, y: number, double: boolean): Line => ({
  points: [
    [from, y],
    [to, y],
  ],
  double,
});

/** The drawing of a chart. */
export function layOutChart(chart: Chart): ChartDrawing {
  const whole = new Drawer(chart).draw();
  const block = moved(whole, MARGIN - whole.left, MARGIN / 2);
  const { lines, arrows, ...all } = flattened(block);
  const elements = all.elements.toSorted((a, b) => a.element.span.at - b.element.span.at);
  return {
    width: Math.ceil(block.right) + MARGIN,
    height: Math.ceil(block.bottom) + MARGIN,
    elements: elements.map((each, index) => ({ ...each, place: [index] })),
    lines,
    arrows,
  };
}

class Drawer {
  private readonly flow: Flow;
  private readonly placed = new Set<string>();

  constructor(private readonly chart: Chart) {
    this.flow = flowOf(chart);
  }

  draw(): Block {
    const columns: Block[] = [];
    for (const step of inDrawingOrder(this.chart.steps))
      if (!this.placed.has(keyOf(step.name))) columns.push(this.finished(this.sequence(step)));
    // Transitions whose steps nobody wrote, or whose paths all became arrows: below an arrow with the names of the steps.
    for (const each of this.chart.transitions)
      if (!this.placed.has(meetingOf(each))) {
        const from = arrow(each.from.join(", "), false);
        columns.push(this.finished(this.met(together([from, moved(this.transition(each, null), 0, from.bottom)]))));
      }
    return sideBySide(columns);
  }

  /** What still waits for paths that never come goes on without them. */
  private finished(block: Block): Block {
    let whole = block;
    for (let [first] = whole.ends; first; [first] = whole.ends) whole = this.meet(whole, first.key);
    return whole;
  }

  /** A step with its actions, and all that follows. */
  private sequence(step: ChartStep): Block {
    const key = keyOf(step.name);
    this.placed.add(key);
    const drawn = stepBlock(step);
    const after = this.flow.after.get(key) ?? [];
    const order = inTestOrder(after);
    const blocks = after.map((each) =>
      each.from.length > 1
        ? this.end(meetingOf(each), each.from.join(", "))
        : this.transition(each, after.length > 1 ? order.indexOf(each) + 1 : null),
    );
    return this.below(drawn, blocks, false);
  }

  private transition(transition: ChartTransition, order: number | null): Block {
    this.placed.add(meetingOf(transition));
    const blocks = transition.to.map((name) => {
      const step = this.flow.steps.get(keyOf(name));
      if (!step || this.placed.has(keyOf(name))) return arrow(name, step === undefined);
      if ((this.flow.paths.get(keyOf(name)) ?? 0) > 1) return this.end(keyOf(name), name);
      return this.sequence(step);
    });
    return this.below(transitionBlock(transition, order), blocks, true);
  }

  /** A path that goes on where it meets others. It has room for an arrow, in case it cannot. */
  private end(key: string, name: string): Block {
    return { ...arrow(name, false), arrows: [], lines: [], ends: [{ key, x: 0, y: 0 }] };
  }

  /** What follows `upper`: one below it, or several beside each other below a line. */
  private below(upper: Block, blocks: readonly Block[], simultaneous: boolean): Block {
    const [first] = blocks;
    if (first === undefined) return upper;
    const y = upper.bottom;
    if (blocks.length === 1) return this.met(together([upper, moved(first, 0, y)]));
    const bar = y + LEAD;
    const beside = sideBySide(blocks, (at) => [line(at, 0, LEAD)]);
    const axes = beside.axes;
    const beyond = simultaneous ? BAR + 6 : 0;
    const lines = [line(0, y, bar), across((axes[0] ?? 0) - beyond, (axes.at(-1) ?? 0) + beyond, bar, simultaneous)];
    return this.met(together([upper, { ...EMPTY, lines }, moved(beside, 0, bar)]));
  }

  /** Goes on at each meeting whose paths have all come. */
  private met(block: Block): Block {
    let whole = block;
    for (;;) {
      const counts = new Map<string, number>();
      for (const { key } of whole.ends) counts.set(key, (counts.get(key) ?? 0) + 1);
      const ready = [...counts].find(([key, count]) => count >= (this.flow.paths.get(key) ?? 0));
      if (!ready) return whole;
      whole = this.meet(whole, ready[0]);
    }
  }

  /** Joins the paths that end at a meeting, and goes on below them. Where they would cross others, those become arrows. */
  private meet(block: Block, key: string): Block {
    const ends = block.ends.filter((each) => each.key === key);
    const meeting = this.flow.meetings.get(key);
    const gone = { ...block, ends: block.ends.filter((each) => each.key !== key) };
    if (!meeting || this.placed.has(key)) return together([gone, ...ends.map((each) => this.instead(each))]);
    const double = meeting.kind === "transition";
    const xs = ends.map(({ x }) => x);
    const [axis, last] = [Math.min(...xs), Math.max(...xs)];
    const y = block.bottom + (ends.length > 1 || double ? 4 : 0);
    const lines = ends.filter((each) => each.y < y).map((each) => line(each.x, each.y, y));
    if (ends.length > 1 || double) lines.push(across(axis - (double ? 22 : 0), last + (double ? 22 : 0), y, double));
    const next =
      meeting.kind === "step"
        ? together([{ ...EMPTY, lines: [line(0, 0, LEAD)] }, moved(this.sequence(meeting.step), 0, LEAD)])
        : this.transition(meeting.transition, null);
    const under = moved(next, axis, y);
    const crossed = gone.ends.filter(
      ({ x }) => x > Math.min(axis, under.left) - 8 && x < Math.max(last, under.right) + 8,
    );
    const arrows = crossed.map((each) => this.instead(each));
    const rest = { ...block, ends: gone.ends.filter((each) => !crossed.includes(each)) };
    return this.met(together([rest, { ...EMPTY, lines }, under, ...arrows]));
  }

  /** An arrow in place of a path that would cross others. */
  private instead({ key, x, y }: { key: string; x: number; y: number }): Block {
    const meeting = this.flow.meetings.get(key);
    this.flow.paths.set(key, (this.flow.paths.get(key) ?? 1) - 1);
    const name = meeting?.kind === "step" ? meeting.step.name : (meeting?.transition.from.join(", ") ?? "");
    return moved(arrow(name, false), x, y);
  }
}

/** Blocks from left to right; the first one keeps its axis. `lead` gives the lines above each. */
function sideBySide(blocks: readonly Block[], lead: (axis: number) => Line[] = () => []): Block & { axes: number[] } {
  const axes: number[] = [];
  const down = lead(0).length > 0 ? LEAD : 0;
  let right = 0;
  const shifted = blocks.map((block, index) => {
    const axis = index === 0 ? 0 : Math.round(right + GAP - block.left);
    right = axis + block.right;
    axes.push(axis);
    return together([{ ...EMPTY, left: axis, right: axis, lines: lead(axis) }, moved(block, axis, down)]);
  });
  return { ...together(shifted), axes };
}

function arrow(name: string, unknown: boolean): Block {
  return {
    ...EMPTY,
    left: -8,
    right: widthOf(name) + 16,
    bottom: ARROW,
    lines: [line(0, 0, ARROW - 9)],
    arrows: [{ x: 0, y: ARROW - 4, name, unknown }],
  };
}

function stepBlock(step: ChartStep): Block {
  const { actions } = step;
  const width = Math.max(STEP_WIDTH, Math.ceil(widthOf(step.name) * 1.05) + 28);
  const height = Math.max(STEP_HEIGHT, actions.length * ACTION_ROW);
  const half = Math.round(width / 2);
  const cell = Math.max(44, ...actions.map((each) => widthOf(qualifierText(each)) + 14));
  const name = Math.max(110, ...actions.map(({ action, indicator }) => widthOf(action + indicator) + 46));
  const x = half + 14;
  const drawn = (element: ChartElement, rest: Partial<ChartDrawn>): ChartDrawn => ({
    ...{ element, place: [], x: -half, y: 0, width, up: 0, down: 0, axis: 0, order: null, cell: 0 },
    ...rest,
  });
  const middle = STEP_HEIGHT / 2;
  const rows = actions.map((each, index) =>
    drawn(each, {
      ...{ x, y: index * ACTION_ROW + ACTION_ROW / 2, width: cell + name, axis: x + cell, cell },
      ...{ up: ACTION_ROW / 2, down: ACTION_ROW / 2 },
    }),
  );
  const lines = actions.length > 0 ? [across(half, x, ACTION_ROW / 2, false)] : [];
  if (height > STEP_HEIGHT) lines.push(line(0, STEP_HEIGHT, height));
  return {
    ...EMPTY,
    left: -half,
    right: actions.length > 0 ? x + cell + name : half,
    bottom: height,
    elements: [drawn(step, { y: middle, up: middle, down: middle }), ...rows],
    lines,
  };
}

function transitionBlock(transition: ChartTransition, order: number | null): Block {
  const text = (transition.name === "" ? 0 : widthOf(transition.name) + 12) + widthOf(shortened(transition.condition));
  const values = transition.rung === null && hasNumbers(transition.condition) ? VALUES : 0;
  const right = BAR + 10 + text + values;
  const left = -BAR - (order === null ? 0 : 16);
  const element: ChartDrawn = {
    ...{ element: transition, place: [], x: left, y: LEAD + 4, width: right - left, up: 11, down: 11, axis: 0 },
    ...{ order, cell: 0 },
  };
  return { ...EMPTY, left, right, bottom: 2 * LEAD + 8, elements: [element], lines: [line(0, 0, 2 * LEAD + 8)] };
}
