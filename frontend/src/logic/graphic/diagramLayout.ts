/**
 * The drawing of a function block diagram: follows from its text alone. The column of a box is the longest way to it, its row the
 * order of the text, and each wire has a track of its own between two columns; it passes columns between boxes.
 */

import { type DiagramInput, type DiagramItem, type DiagramOutput, NOTHING } from "./diagram";
import type { Place } from "./ladderLayout";
import { isVariable, VALUE, widthOf } from "./measure";

export interface DiagramPinDrawn<Pin> {
  pin: Pin;
  y: number;
  /** Of an input: its wire is set in a line below, or nowhere. */
  from: "wire" | "loop" | "nothing" | "text";
}

export interface DiagramDrawn {
  element: { kind: DiagramItem["kind"]; span: DiagramItem["span"]; item: DiagramItem };
  place: Place;
  x: number;
  /** The middle. */
  y: number;
  width: number;
  up: number;
  down: number;
  /** In the order of execution, from 1. */
  order: number;
  inputs: readonly DiagramPinDrawn<DiagramInput>[];
  outputs: readonly DiagramPinDrawn<DiagramOutput>[];
}

interface DiagramWire {
  /** Its key. */
  wire: string;
  points: readonly (readonly [number, number])[];
}

export interface DiagramDrawing {
  width: number;
  height: number;
  elements: readonly DiagramDrawn[];
  wires: readonly DiagramWire[];
}

const ROW = 20;
const FIRST = 30;
const GAP = 16;
const TRACK = 10;
const MARGIN = 8;
/** From a pin to its text. */
export const STUB = 14;

const LONGEST = 40;
export const shortPin = (text: string) => (text.length > LONGEST ? `${text.slice(0, LONGEST - 1)}…` : text);
/** How wide the text of a pin is, with its value. */
export const textWidth = (text: string) => widthOf(shortPin(text)) + (isVariable(text) ? VALUE : 0) + STUB + 6;

interface Node {
  item: DiagramItem;
  order: number;
  column: number;
  y: number;
  width: number;
  height: number;
  inputs: DiagramPinDrawn<DiagramInput>[];
}

/** A wire at the right side of a column: from a pin of a box, or as it passes. */
interface Row {
  wire: string;
  y: number;
}

export function layOutDiagram(items: readonly DiagramItem[]): DiagramDrawing {
  return new Layout(items).drawing();
}

class Layout {
  private readonly nodes: Node[] = [];
  /** The node and the pin that set each wire. */
  private readonly sources = new Map<string, { node: Node; pin: number }>();
  private readonly bottoms: number[] = [];
  /** The rows in which wires leave each column, and come into each. */
  private readonly leaves: Row[][] = [];
  private readonly comes: Row[][] = [];

  constructor(items: readonly DiagramItem[]) {
    for (const [index, item] of items.entries()) this.add(item, index);
    for (const node of this.nodes) this.put(node);
  }

  private add(item: DiagramItem, index: number): void {
    let column = 0;
    const inputs = item.inputs.map((pin): DiagramPinDrawn<DiagramInput> => {
      const source = pin.wire === null ? undefined : this.sources.get(pin.wire);
      if (source) column = Math.max(column, source.node.column + 1);
      const text = pin.text === NOTHING ? "nothing" : "text";
      return { pin, y: 0, from: pin.wire === null ? text : source ? "wire" : "nothing" };
    });
    const node = { item, order: index + 1, column, y: 0, ...sizeOf(item), inputs };
    this.nodes.push(node);
    item.outputs.forEach(({ wire }, pin) => {
      if (wire === null) return;
      this.sources.set(wire, { node, pin });
      // Who read it in a line above has its value of the last evaluation.
      for (const each of this.nodes)
        for (const input of each.inputs) if (input.from === "nothing" && input.pin.wire === wire) input.from = "loop";
    });
  }

  /** Places a node below those of its column, with its first wire straight where there is room. */
  private put(node: Node): void {
    const { column, item } = node;
    const wired = node.inputs.flatMap(({ pin, from }, index) =>
      from === "wire" && pin.wire ? [{ wire: pin.wire, index }] : [],
    );
    const rows = wired.map(({ wire, index }) => ({ wire, index, y: this.rowBefore(wire, column) }));
    const [first] = rows;
    const bottom = this.bottoms[column] ?? MARGIN;
    node.y = Math.max(bottom, first ? first.y - pinY(node, first.index) : 0);
    const meets = (rows: readonly Row[] | undefined, wire: string, y: number) =>
      rows?.some((row) => row.wire !== wire && Math.abs(row.y - y) < 4);
    const outs = item.outputs.flatMap(({ wire }, index) => (wire === null ? [] : [{ wire, index }]));
    // Two wires must not lie in one row between the same columns.
    for (let tries = 0; tries < 60; tries += 1) {
      const here = (index: number) => node.y + pinY(node, index);
      const crowded =
        wired.some(({ wire, index }) => meets(this.leaves[column - 1], wire, here(index))) ||
        outs.some(({ wire, index }) => meets(this.comes[column + 1], wire, here(index)));
      if (!crowded) break;
      node.y += 5;
    }
    node.y = Math.round(node.y);
    this.bottoms[column] = node.y + node.height + GAP;
    for (const { wire, index } of wired) add(this.comes, column, { wire, y: node.y + pinY(node, index) });
    for (const { wire, index } of outs) add(this.leaves, column, { wire, y: node.y + pinY(node, index) });
  }

  /** The row in which a wire leaves the column before this one: it passes the columns between below what is there. */
  private rowBefore(wire: string, column: number): number {
    const source = this.sources.get(wire);
    if (!source) return 0;
    let y = source.node.y + pinY(source.node, source.pin);
    for (let at = source.node.column + 1; at < column; at += 1) {
      const known = this.leaves[at]?.find((row) => row.wire === wire);
      if (known) {
        y = known.y;
        continue;
      }
      y = Math.max(y, (this.bottoms[at] ?? MARGIN) + 4);
      const taken = (rows: readonly Row[] | undefined) =>
        rows?.some((row) => row.wire !== wire && Math.abs(row.y - y) < 4);
      while (taken(this.leaves[at - 1]) || taken(this.comes[at + 1])) y += 5;
      this.bottoms[at] = y + GAP;
      add(this.comes, at, { wire, y });
      add(this.leaves, at, { wire, y });
    }
    return y;
  }

  drawing(): DiagramDrawing {
    const { left, zones, right } = this.columns();
    const elements = this.nodes.map((node, index) => this.drawn(node, index, left[node.column] ?? 0));
    const wires = [...this.sources.keys()].flatMap((wire) => this.path(wire, left, zones));
    const bottom = Math.max(0, ...this.bottoms) - GAP;
    return { width: Math.ceil(right) + MARGIN, height: Math.max(24, bottom) + MARGIN, elements, wires };
  }

  /** Where the boxes of each column begin, and the tracks before it. */
  private columns(): { left: number[]; zones: { at: number; tracks: string[] }[]; right: number } {
    const left: number[] = [];
    const zones: { at: number; tracks: string[] }[] = [];
    let x = MARGIN;
    const count = Math.max(0, ...this.nodes.map(({ column }) => column + 1));
    for (let column = 0; column < count; column += 1) {
      const here = this.nodes.filter((node) => node.column === column);
      const tracks = [...new Set((this.comes[column] ?? []).map(({ wire }) => wire))];
      zones.push({ at: x + 6, tracks });
      const lead = here.flatMap(({ inputs }) =>
        inputs.map(({ pin, from }) =>
          from === "wire" ? 10 : from === "loop" ? widthOf(pin.text) + 46 : textWidth(pin.text),
        ),
      );
      x += tracks.length * TRACK + 8 + Math.max(0, ...lead);
      left.push(Math.round(x));
      const trail = here.flatMap(({ item, width }) => item.outputs.map((out) => width + trailOf(out)));
      x = Math.round(x) + Math.max(20, ...here.map(({ width }) => width), ...trail);
    }
    return { left, zones, right: x };
  }

  private drawn({ item, order, y, width, height, inputs }: Node, index: number, x: number): DiagramDrawn {
    const middle = y + height / 2;
    return {
      element: { kind: item.kind, span: item.span, item },
      ...{ place: [index], x, y: middle, width, up: height / 2, down: height / 2, order },
      inputs: inputs.map((each, pin) => ({ ...each, y: y + pinYOf(item.kind, pin) })),
      outputs: item.outputs.map((pin, at) => ({ pin, y: y + pinYOf(item.kind, at), from: "text" as const })),
    };
  }

  /** The lines of a wire: from its pin, through the columns that it passes, to each pin that reads it. */
  private path(
    wire: string,
    left: readonly number[],
    zones: readonly { at: number; tracks: string[] }[],
  ): DiagramWire[] {
    const source = this.sources.get(wire);
    if (!source) return [];
    const found: DiagramWire[] = [];
    const { node } = source;
    const start = (left[node.column] ?? 0) + node.width;
    let from = { x: start, y: node.y + pinY(node, source.pin) };
    for (let column = node.column + 1; column < left.length; column += 1) {
      const rows = (this.comes[column] ?? []).filter((row) => row.wire === wire);
      if (rows.length === 0) break;
      const zone = zones[column];
      const track = (zone?.at ?? 0) + (zone?.tracks.indexOf(wire) ?? 0) * TRACK;
      const passes = this.leaves[column]?.find((row) => row.wire === wire);
      for (const { y } of rows) {
        const end = left[column] ?? 0;
        const points: [number, number][] = [
          [from.x, from.y],
          [track, from.y],
          [track, y],
          [end, y],
        ];
        found.push({
          wire,
          points:
            y === from.y
              ? [
                  [from.x, y],
                  [end, y],
                ]
              : points,
        });
      }
      if (!passes) break;
      from = { x: left[column] ?? 0, y: passes.y };
    }
    const target = Math.max(...found.map(({ points }) => points.at(-1)?.[0] ?? 0));
    if (found.length === 0)
      found.push({
        wire,
        points: [
          [from.x, from.y],
          [from.x + STUB, from.y],
        ],
      });
    return target === 0 ? [] : found;
  }
}

function add(rows: Row[][], column: number, row: Row): void {
  const known = rows[column];
  if (known) known.push(row);
  else rows[column] = [row];
}

const pinYOf = (kind: DiagramItem["kind"], index: number) => (kind === "box" ? FIRST : 10) + index * ROW;
const pinY = ({ item }: Pick<Node, "item">, index: number) => pinYOf(item.kind, index);

/** What is to the right of an output: its variable, or the name of its wire. */
const trailOf = ({ target, wire, operator }: DiagramOutput) =>
  wire === null ? textWidth(target) + (operator === "" ? 0 : 20) : widthOf(target) + VALUE / 2 + 12;

function sizeOf({ kind, callee, inputs, outputs, label }: DiagramItem): { width: number; height: number } {
  if (kind === "leave") return { width: widthOf(label === "" ? "RETURN" : label) + 24, height: 20 };
  if (kind === "value") return { width: 12, height: 20 };
  const widest = (names: readonly string[]) => Math.max(0, ...names.map(widthOf));
  const rows = Math.max(1, inputs.length, outputs.length);
  return {
    width: Math.max(
      52,
      widthOf(callee) + 34,
      widest(inputs.map(({ name }) => name)) + widest(outputs.map(({ name }) => name)) + 34,
    ),
    height: FIRST + (rows - 1) * ROW + 14,
  };
}
