/** Where the two sides of a verification part in a drawing: at which elements and pins values differ, and on which wires. */

import type { DiagramDrawn } from "./diagramLayout";
import { pinsOf } from "./diagramPins";
import { type PartFlow, type Seen, seenPower } from "./flow";
import type { Drawing, Drawn, Place } from "./ladderLayout";
import type { DrawnPart, Spot } from "./sheet";

/** A pair of values, beside what they are of. */
export interface Apart {
  /** The place of the element or pin, joined by points, or the wire. */
  key: string;
  /** Where it is drawn: `end`: its right end, below the line; `middle`: its middle, above the line. */
  x: number;
  y: number;
  at: "end" | "middle";
  /** Empty where the drawing says it at this place. */
  name: string;
  /** Of the control device, and of the monitor; null where that side has none, as the element did not run there, or wrote nothing. */
  control: string | null;
  monitor: string | null;
  /** Power, and no value. */
  power: boolean;
  /** More values of this element that differ. */
  more: readonly { name: string; control: string | null; monitor: string | null }[];
  /** What differed first. */
  first: boolean;
}

export interface AllApart {
  marks: readonly Apart[];
  /** The wires, each with the side that has the power: `3A 5B`. Of a network the names of those that differ, as `#LOWX`. */
  wires: string;
}

type Sides = readonly [PartFlow, PartFlow];
type Pair = Pick<Apart, "name" | "control" | "monitor">;

const keyOf = (place: Place) => place.join(".");

/** All in one part. `first`: the place of the element that differed first, where it is in this part. */
export function apartIn(part: DrawnPart, sides: Sides, first: Place | null): AllApart {
  const firstKey = first === null ? null : keyOf(first);
  const marked = marksIn(part, sides).map((mark) => ({ ...mark, first: elementKey(part, mark.key) === firstKey }));
  // Of one element that differed first with several pins, the first one is marked.
  const cause = marked.find((mark) => mark.first && !mark.power);
  const marks = marked.map((mark) => ({ ...mark, first: mark === cause }));
  if (part.kind === "rung" && part.drawing) {
    const wires = powersIn(part.drawing, sides);
    return { marks: [...marks, ...wires.marks], wires: wires.text };
  }
  return {
    marks,
    wires:
      part.kind === "network"
        ? wiresIn(sides)
            .map((name) => `${name}X`)
            .join(" ")
        : "",
  };
}

/** Of a pin that of its item. */
const elementKey = (part: DrawnPart, key: string) => (part.kind === "network" ? (key.split(".")[0] ?? key) : key);

function marksIn(part: DrawnPart, sides: Sides): Apart[] {
  switch (part.kind) {
    case "rung":
      return (part.drawing?.elements ?? []).flatMap((drawn) =>
        drawn.frame ? boxMarks(drawn, sides) : spotMarks(drawn, sides, true),
      );
    case "network": {
      if (!part.drawing) return [];
      const pins = pinsOf(part.drawing);
      return part.drawing.elements.flatMap((drawn) => itemMarks(drawn, pins, sides));
    }
    case "chart":
      return (part.drawing?.elements ?? []).flatMap((drawn) => spotMarks(drawn, sides, false));
  }
}

/** The values that an element has on the two sides, where they are not the same. */
function pairsOf(one: Seen | undefined, other: Seen | undefined): Pair[] {
  const names = new Map<string, string>();
  for (const seen of [one, other]) for (const { name } of seen?.values ?? []) names.set(name.toUpperCase(), name);
  const used = (seen: Seen | undefined, key: string, written: boolean) =>
    seen?.values.findLast((each) => each.name.toUpperCase() === key && each.written === written);
  const both = one !== undefined && other !== undefined;
  return [...names].flatMap(([key, name]) => {
    const [before, after] = [used(one, key, false), used(other, key, false)];
    const [wrote, wroteToo] = [used(one, key, true), used(other, key, true)];
    // What it wrote tells more than what it read before.
    const [control, monitor] = [(wrote ?? before)?.text ?? null, (wroteToo ?? after)?.text ?? null];
    // That an element read something on one side only makes no value different.
    const onlyRead = both && !wrote && !wroteToo && (control === null || monitor === null);
    if (control !== monitor && !onlyRead) return [{ name, control, monitor }];
    return before && after && before.text !== after.text ? [{ name, control: before.text, monitor: after.text }] : [];
  });
}

const mark = (spot: Pick<Spot, "x" | "y" | "width">, key: string, pair: Pair, more: readonly Pair[]): Apart => ({
  ...{ key, x: spot.x + spot.width, y: spot.y, at: "end", power: false, first: false },
  ...pair,
  more,
});

/** One mark for an element. Whether it ran on one side only is told of a step, which is active there; of other elements where it has values. */
function spotMarks(spot: Spot, [one, other]: Sides, bare: boolean): Apart[] {
  const key = keyOf(spot.place);
  const [here, there] = [one.at.get(key), other.at.get(key)];
  if (spot.element.kind === "step" && (here === undefined) !== (there === undefined)) {
    const active = (seen: Seen | undefined) => (seen === undefined ? "FALSE" : "TRUE");
    return [mark(spot, key, { name: "X", control: active(here), monitor: active(there) }, [])];
  }
  const [first, ...more] = pairsOf(here, there);
  if (!first) return [];
  return [mark(spot, key, bare && more.length === 0 ? { ...first, name: "" } : first, more)];
}

/** The pins of a box of a rung; what differs inside of the block is no business of the drawing. */
function boxMarks(drawn: Drawn, [one, other]: Sides): Apart[] {
  const { element, frame, place } = drawn;
  if (element.kind !== "box" || !frame) return [];
  const key = keyOf(place);
  const [here, there] = [one.at.get(key), other.at.get(key)];
  // A block that was called on both sides has values on both: where it touched a pin on one side only nothing is told of the other.
  const known = ({ control, monitor }: Pair) => !here || !there || (control !== null && monitor !== null);
  const pairs = pairsOf(here, there).filter(known);
  const of = (name: string) => pairs.find((each) => each.name.toUpperCase() === name.replace(/\s/g, "").toUpperCase());
  const found: Apart[] = [];
  for (const [pins, x] of [
    [frame.inputs, frame.x - 8],
    [frame.outputs, frame.x + frame.width + 8],
  ] as const)
    for (const pin of pins) {
      const pair = of(`${element.callee}.${pin.name}`) ?? (pin.text === "" ? undefined : of(pin.text));
      if (!pair) continue;
      const right = pins === frame.outputs;
      found.push({ ...mark({ x, y: pin.y, width: right ? 80 : 0 }, key, { ...pair, name: "" }, []) });
    }
  return found;
}

/** The pins of an item of a network: values of variables, and of the wires that come out of it. */
function itemMarks(drawn: DiagramDrawn, pins: ReturnType<typeof pinsOf>, [one, other]: Sides): Apart[] {
  const place = keyOf(drawn.place);
  const pairs = pairsOf(one.at.get(place), other.at.get(place));
  return pins.flatMap((pin): Apart[] => {
    if (pin.of !== drawn) return [];
    const { inputs, outputs } = drawn.element.item;
    const input = pin.side === "input" ? inputs[pin.index] : undefined;
    const output = pin.side === "output" ? outputs[pin.index] : undefined;
    const key = keyOf(pin.place);
    if (output?.wire) {
      const wire = output.wire.toUpperCase();
      const [control, monitor] = [one.wires.get(wire) ?? null, other.wires.get(wire) ?? null];
      if (control === monitor) return [];
      return [mark({ ...pin, width: 96 }, key, { name: "", control, monitor }, [])];
    }
    const text = (output?.target ?? (input?.wire ? "" : (input?.text ?? ""))).replace(/\s/g, "").toUpperCase();
    const pair = pairs.find((each) => text !== "" && each.name.toUpperCase() === text);
    return pair ? [mark(pin, key, { ...pair, name: "" }, [])] : [];
  });
}

function wiresIn([one, other]: Sides): string[] {
  const names = new Set([...one.wires.keys(), ...other.wires.keys()]);
  return [...names].filter((name) => (one.wires.get(name) ?? null) !== (other.wires.get(name) ?? null));
}

/** The least length of a wire beside which there is room for two values. */
const ROOM = 40;

/** Where a wire goes from left to right: what is drawn piece by piece is one stretch. */
function stretchesOf({ wires }: Drawing, node: number): { x: number; to: number; y: number }[] {
  const found: { x: number; to: number; y: number }[] = [];
  for (const wire of wires) {
    const [from, to] = wire.points;
    if (wire.node !== node || !from || !to || from[1] !== to[1]) continue;
    const before = found.find((each) => each.y === from[1] && each.to === from[0]);
    if (before) before.to = to[0];
    else found.push({ x: from[0], to: to[0], y: from[1] });
  }
  return found;
}

/** Wires of a rung that have power on one side only. Each is told once, at its longest stretch. */
function powersIn(drawing: Drawing, [one, other]: Sides): { marks: Apart[]; text: string } {
  const [control, monitor] = [seenPower(drawing, one), seenPower(drawing, other)];
  const differs = drawing.nodes.flatMap((_, node) => {
    const [here, there] = [control[node]?.power ?? null, monitor[node]?.power ?? null];
    return here === null || there === null || here === there ? [] : [{ node, here, there }];
  });
  const marks = differs.flatMap(({ node, here, there }): Apart[] => {
    const longest = stretchesOf(drawing, node).sort((a, b) => b.to - b.x - (a.to - a.x))[0];
    if (!longest || longest.to - longest.x < ROOM) return [];
    const { x, to, y } = longest;
    const [power, values] = [true, { control: here ? "1" : "0", monitor: there ? "1" : "0" }];
    return [
      { key: `wire${node}`, x: (x + to) / 2, y, at: "middle", name: "", ...values, power, more: [], first: false },
    ];
  });
  return { marks, text: differs.map(({ node, here }) => `${node}${here ? "A" : "B"}`).join(" ") };
}
