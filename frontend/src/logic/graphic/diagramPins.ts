/** The pins of a function block diagram as places of the cursor: after an item's inputs come its outputs. */

import { type DiagramDrawing, type DiagramDrawn, STUB, textWidth } from "./diagramLayout";
import type { Place, Way } from "./ladderLayout";

export interface PinSpot {
  place: Place;
  x: number;
  y: number;
  width: number;
  element: { kind: "pin"; span: { at: number; end: number } };
  of: DiagramDrawn;
  /** Its number among the inputs, or the outputs. */
  index: number;
  side: "input" | "output";
}

const NEAR = 16;

export function pinsOf({ elements }: DiagramDrawing): PinSpot[] {
  return elements.flatMap((of) => {
    const { element, inputs, outputs } = of;
    const [index = 0] = of.place;
    const base = { of, element: { kind: "pin" as const, span: element.span } };
    const left = inputs.map(({ pin, y, from }, at): PinSpot => {
      const width = from === "wire" ? NEAR : textWidth(pin.text) + (from === "loop" ? 24 : 0);
      return { ...base, place: [index, at], x: of.x - width, y, width, index: at, side: "input" };
    });
    const right = outputs.map(({ pin, y }, at): PinSpot => {
      const marked = pin.operator === "" ? 0 : 20;
      const width = pin.wire === null ? STUB + textWidth(pin.target) + marked : NEAR;
      return { ...base, place: [index, inputs.length + at], x: of.x + of.width, y, width, index: at, side: "output" };
    });
    return [...left, ...right];
  });
}

/** Where the cursor goes along a wire, from a pin to its item, or to the next pin of that side; null where none of these is. */
export function alongWire({ elements }: DiagramDrawing, [index = 0, pin]: Place, way: Way): Place | null {
  const drawn = elements[index];
  if (!drawn) return null;
  const { inputs, outputs } = drawn.element.item;
  const first = inputs.length;
  if (pin === undefined) {
    if (way === "left" && first > 0) return [index, 0];
    return way === "right" && outputs.length > 0 ? [index, first] : null;
  }
  const output = pin >= first;
  if (way === "up" || way === "down") {
    const next = pin + (way === "up" ? -1 : 1);
    const same = output ? next >= first && next < first + outputs.length : next >= 0 && next < first;
    return same ? [index, next] : null;
  }
  if (way === (output ? "left" : "right")) return [index];
  const wire = output ? outputs[pin - first]?.wire : inputs[pin]?.wire;
  if (!wire) return null;
  for (const [at, { element }] of elements.entries()) {
    const pins = output ? element.item.inputs : element.item.outputs;
    const found = pins.findIndex((each) => each.wire === wire);
    if (found >= 0) return [at, output ? found : element.item.inputs.length + found];
  }
  return null;
}
