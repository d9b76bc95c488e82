/**
 * The drawing of a rung: follows from the rung alone, so that it is the same in every browser and at every time. Left to right, a
 * branch below the other, coils at the right rail.
 */

import { writeArgument } from "./args";
import { progressOf, type TypeOf, UNKNOWN } from "./instanceTypes";
import { isVariable, VALUE, widthOf } from "./measure";
import type { PowerNode } from "./power";
import type { Argument, Box, Element, Parallel, Path, Span } from "./tree";

/** Indexes from the rung to an element or a branch: element, branch, element, and so on. Of even length: the start of a path. */
export type Place = readonly number[];

/** Where an arrow key leads. */
export type Way = "left" | "right" | "up" | "down";

interface Wire {
  points: readonly (readonly [number, number])[];
  /** The node whose power it carries. */
  node: number;
}

export interface Drawn {
  element: Exclude<Element, Parallel>;
  place: Place;
  /** The left end of its wire, and the rectangle that belongs to it. */
  x: number;
  y: number;
  width: number;
  up: number;
  down: number;
  before: number;
  after: number;
  /** Of a box: where its frame is. */
  frame: Frame | null;
}

export interface Frame {
  /** What is called: the type of an instance, which is above the frame; else the same as `callee`. */
  type: string;
  callee: string;
  /** The variable whose value is shown below; empty where there is none. */
  progress: string;
  x: number;
  y: number;
  width: number;
  height: number;
  inputs: readonly Pin[];
  outputs: readonly Pin[];
}

interface Pin {
  /** The number of its argument, `RESULT` for the variable of the result; -1 for the output that the power goes on from. */
  arg: number;
  /** What is written inside of the frame. */
  name: string;
  /** What is written beside it; empty where the wire of the rung is. */
  text: string;
  y: number;
  power: boolean;
}

export interface Drawing {
  width: number;
  height: number;
  wires: readonly Wire[];
  elements: readonly Drawn[];
  nodes: readonly PowerNode[];
  /** The nodes that send power to a link, by its name in upper case. */
  sends: ReadonlyMap<string, readonly number[]>;
  /** Where branches join again, and branches without an element: a cursor can be there, too. */
  gaps: readonly Gap[];
  rail: { left: number; right: number; top: number; bottom: number };
  /** The node at the end of the rung. */
  end: number;
}

/** A place on a wire. */
interface Gap {
  element: { kind: "gap"; span: Span };
  place: Place;
  x: number;
  y: number;
  width: number;
}

/** In place of the number of an argument: the variable that takes the result. */
export const RESULT = -2;
const LEFT = 4;
const RIGHT = 6;
const LEAST = 80;
const UP = 27;
const DOWN = 17;
const LEAD = 16;
const ROW = 20;
const GAP = 8;
const EMPTY = 40;
/** How far a timer or counter is, below its frame. */
const PROGRESS = 14;

interface Size {
  width: number;
  up: number;
  down: number;
}

/** Whether it is drawn at the right rail. */
export const isEnd = (element: Element | undefined): boolean =>
  element !== undefined &&
  (["coil", "send", "jump"].includes(element.kind) ||
    (element.kind === "parallel" && element.branches.some((branch) => isEnd(branch.at(-1)))));

/** The drawing in at least this width. */
export function layOut(path: Path, width: number, typeOf: TypeOf = UNKNOWN): Drawing {
  const size = sizeOfPath(path, typeOf);
  const whole = Math.max(width, Math.ceil(size.width) + LEFT + RIGHT + 2 * LEAD);
  const y = size.up + 2;
  const drawer = new Drawer(path, typeOf);
  const end = drawer.draw(LEFT, whole - RIGHT, y);
  const bottom = y + size.down;
  return {
    width: whole,
    height: Math.round(bottom + 10),
    wires: drawer.wires,
    elements: drawer.elements,
    nodes: drawer.nodes,
    sends: drawer.sends,
    gaps: drawer.gaps,
    rail: { left: LEFT, right: whole - RIGHT, top: y - 13, bottom: Math.max(y + 14, bottom) },
    end,
  };
}

/** Where the part that is drawn at the right rail begins. */
function tailOf(path: Path): number {
  let from = path.length;
  while (from > 0 && isEnd(path[from - 1])) from -= 1;
  return from;
}

function sizeOfPath(path: Path, typeOf: TypeOf): Size {
  let [width, up, down] = [path.length === 0 ? EMPTY : 0, 10, 10];
  path.forEach((element, index) => {
    const size = sizeOf(element, index === path.length - 1, typeOf);
    width += size.width;
    up = Math.max(up, size.up);
    down = Math.max(down, size.down);
  });
  return { width, up, down };
}

function sizeOf(element: Element, last: boolean, typeOf: TypeOf): Size {
  switch (element.kind) {
    case "contact":
    case "coil":
      return { width: Math.max(LEAST, widthOf(element.operand) + 24), up: UP, down: DOWN };
    case "parallel": {
      const { up, down, inner } = branchesOf(element, typeOf);
      return { width: inner + LEAD + (last && isEnd(element) ? 0 : LEAD), up, down };
    }
    case "box": {
      const { before, inner, trail, rows, progress } = boxOf(element, typeOf);
      return { width: before + inner + trail, up: 52, down: (rows - 1) * ROW + 16 + (progress === "" ? 0 : PROGRESS) };
    }
    case "send":
    case "receive":
      return { width: widthOf(element.name) + 46, up: 14, down: 14 };
    case "jump":
      return { width: widthOf(element.label ?? "RETURN") + 44, up: 14, down: 14 };
  }
}

/** The branches of a parallel: their heights below its first one, and the width of the widest. */
function branchesOf({ branches }: Parallel, typeOf: TypeOf) {
  const sizes = branches.map((branch) => sizeOfPath(branch, typeOf));
  const rows: number[] = [];
  let down = 0;
  sizes.forEach((size, index) => {
    const y = index === 0 ? 0 : down + GAP + size.up;
    rows.push(y);
    down = y + size.down;
  });
  return { sizes, rows, up: sizes[0]?.up ?? 10, down, inner: Math.max(EMPTY, ...sizes.map(({ width }) => width)) };
}

const isPower = ({ out, value, branch }: Argument) => !out && branch === null && value === "~";

/** The pins of a box and how wide its parts are: texts before it, its frame, texts after it. */
function boxOf(box: Box, typeOf: TypeOf) {
  const inputs = box.args.filter(({ out }) => !out);
  const named = box.args.filter(({ out }) => out);
  const power = inputs.find(isPower);
  // The power comes in at the height of the wire, which is that of the first row.
  const ins = power ? [power, ...inputs.filter((each) => each !== power)] : inputs;
  const outs = [
    ...(box.output === null ? [] : [{ arg: -1, name: box.output, text: "", power: true }]),
    ...(box.result === null ? [] : [{ arg: RESULT, name: "", text: box.result, power: false }]),
    ...named.map((each) => ({ arg: box.args.indexOf(each), name: each.name ?? "", text: each.value, power: false })),
  ];
  const left = ins.map((each) => ({
    arg: box.args.indexOf(each),
    name: each.name ?? "",
    text: isPower(each) ? "" : textOf(each),
    power: isPower(each),
  }));
  const widest = (texts: readonly string[]) => Math.max(0, ...texts.map(widthOf));
  const type = typeOf(box.callee);
  const output = progressOf(type);
  const progress = output ? `${box.callee}.${output}` : "";
  const withValue = (text: string) => widthOf(text) + (text !== "" && isVariable(text) ? VALUE : 0);
  const inner = Math.max(
    widthOf(box.callee) + 24,
    widthOf(type ?? "") + 24,
    widest(left.map(({ name }) => name)) + widest(outs.map(({ name }) => name)) + 34,
  );
  const before = Math.max(0, ...left.map(({ text }) => withValue(text))) + 22;
  const trail = Math.max(18, ...outs.map(({ text }) => withValue(text) + 22));
  const shifted = power === undefined && box.output === null ? 1 : 0;
  const rows = Math.max(1, left.length + shifted, outs.length + shifted);
  return { before, inner, trail, left, outs, shifted, rows, type: type ?? box.callee, progress };
}

const textOf = (arg: Argument) => writeArgument({ ...arg, name: null });

class Drawer {
  readonly wires: Wire[] = [];
  readonly elements: Drawn[] = [];
  readonly nodes: PowerNode[] = [{ kind: "rail" }];
  readonly sends = new Map<string, number[]>();
  readonly gaps: Gap[] = [];

  constructor(
    private readonly path: Path,
    private readonly typeOf: TypeOf,
  ) {}

  draw(left: number, right: number, y: number): number {
    return this.flush(this.path, [], left, right, y, 0);
  }

  /** Draws a path between two rails: what ends it is at the right one. */
  private flush(path: Path, place: Place, left: number, right: number, y: number, node: number): number {
    const tail = tailOf(path);
    const main = this.run(path.slice(0, tail), place, 0, left, y, node);
    const rest = path.slice(tail);
    const start = right - sizeOfPath(rest, this.typeOf).width - (rest.length === 0 ? -EMPTY : 0);
    this.wire(main.x, start, y, main.node);
    const end = this.run(rest, place, tail, start, y, main.node);
    if (end.x < right) this.wire(end.x, right, y, end.node);
    return end.node;
  }

  /** Draws elements one after the other. */
  private run(path: Path, place: Place, first: number, x: number, y: number, node: number) {
    let at = { x, node };
    path.forEach((element, index) => {
      const here = [...place, first + index];
      const last = index === path.length - 1;
      at = element.kind === "parallel" ? this.parallel(element, here, at, y, last) : this.single(element, here, at, y);
    });
    return at;
  }

  private single(
    element: Exclude<Element, Parallel>,
    place: Place,
    { x, node }: { x: number; node: number },
    y: number,
  ) {
    const { width, up, down } = sizeOf(element, false, this.typeOf);
    const after = this.after(element, node);
    const frame = element.kind === "box" ? this.box(element, x, y, width, node, after) : null;
    if (element.kind !== "box") {
      const middle = Math.round(x + width / 2);
      const half = element.kind === "contact" ? 5 : element.kind === "coil" ? 9 : 0;
      const ends = element.kind === "send" || element.kind === "jump";
      this.wire(x, ends ? x + 14 : middle - half, y, node);
      if (!ends) this.wire(middle + half, x + width, y, after);
    }
    this.elements.push({ element, place, x, y, width, up, down, before: node, after, frame });
    return { x: x + width, node: after };
  }

  /** The node after an element; for coils it is the same, because a coil copies its left link to its right. */
  private after(element: Exclude<Element, Parallel>, node: number): number {
    switch (element.kind) {
      case "contact":
        return this.node({ kind: "contact", from: node, contact: element });
      case "box":
        return this.node({ kind: "box", from: node, box: element });
      case "receive":
        return this.node({ kind: "receive", from: node, name: element.name });
      case "send": {
        const key = element.name.toUpperCase();
        this.sends.set(key, [...(this.sends.get(key) ?? []), node]);
        return this.node({ kind: "end" });
      }
      case "jump":
        return this.node({ kind: "end" });
      case "coil":
        return node;
    }
  }

  private box(box: Box, x: number, y: number, width: number, node: number, after: number): Frame {
    const { before, inner, left, outs, shifted, rows, type, progress } = boxOf(box, this.typeOf);
    const frame = {
      type,
      callee: box.callee,
      progress,
      x: x + before,
      y: y - 30,
      width: inner,
      height: 30 + (rows - 1) * ROW + 14,
    };
    const pinY = (index: number) => y + (index + shifted) * ROW;
    this.wire(x, frame.x, y, node);
    this.wire(frame.x + inner, x + width, y, after);
    return {
      ...frame,
      inputs: left.map((pin, index) => ({ ...pin, y: pinY(index) })),
      outputs: outs.map((pin, index) => ({
        ...pin,
        y: pinY(box.output === null && shifted === 0 ? index + 1 : index),
      })),
    };
  }

  private parallel(
    element: Parallel,
    place: Place,
    { x, node }: { x: number; node: number },
    y: number,
    last: boolean,
  ) {
    const { sizes, rows, inner } = branchesOf(element, this.typeOf);
    const open = last && isEnd(element);
    const [left, right] = [x + LEAD, x + LEAD + inner];
    this.wire(x, left, y, node);
    const ends = element.branches.map((branch, index) => {
      const row = y + (rows[index] ?? 0);
      const here = [...place, index];
      if (index > 0) this.upright(left, y + (rows[index - 1] ?? 0), row, node);
      if (branch.length === 0) {
        const middle = Math.round((left + right) / 2);
        this.gaps.push({ element: { kind: "gap", span: element.span }, place: here, x: middle - 7, y: row, width: 14 });
      }
      const shift = open ? inner - (sizes[index]?.width ?? 0) : 0;
      if (shift > 0) this.wire(left, left + shift, row, node);
      const end = this.run(branch, here, 0, left + shift, row, node);
      if (end.x < right && !isSink(branch.at(-1))) this.wire(end.x, right, row, end.node);
      if (branch.length === 0) this.wire(left, right, row, node);
      return { row, node: end.node };
    });
    const joined = this.node({ kind: "join", from: ends.map((end) => end.node) });
    if (open) return { x: right, node: joined };
    ends.slice(1).forEach(({ row }, index) => {
      const below = this.node({ kind: "join", from: ends.slice(index + 1).map((end) => end.node) });
      this.upright(right, ends[index]?.row ?? y, row, below);
    });
    this.wire(right, right + LEAD, y, joined);
    this.gaps.push({ element: { kind: "gap", span: element.span }, place, x: right + 1, y, width: LEAD - 2 });
    return { x: right + LEAD, node: joined };
  }

  private node(node: PowerNode): number {
    this.nodes.push(node);
    return this.nodes.length - 1;
  }

  private wire(from: number, to: number, y: number, node: number): void {
    if (to > from)
      this.wires.push({
        points: [
          [from, y],
          [to, y],
        ],
        node,
      });
  }

  private upright(x: number, from: number, to: number, node: number): void {
    this.wires.push({
      points: [
        [x, from],
        [x, to],
      ],
      node,
    });
  }
}

/** Jumps and sent links give no power on, so no wire leaves them. */
const isSink = (element: Element | undefined) => element?.kind === "send" || element?.kind === "jump";
