/** The pins of a box in a rung: the one at a point, the next that is open, and the field of one. */

import { writeArgument, writeElement } from "./args";
import { NOTHING } from "./diagram";
import { type Edit, isOnePiece, type Naming, withDeclared } from "./edit";
import { elementOf } from "./field";
import { type Drawing, type Drawn, type Frame, type Place, RESULT } from "./ladderLayout";
import type { Box } from "./tree";

/** How far from the middle of its row a click means a pin. */
const NEAR = 9;

/** What is named there as `Pin:` and its number: that of its argument, or that of the result. Null where a click means the box. */
export function pinAtPoint({ elements }: Drawing, x: number, y: number): { place: Place; pin: number } | null {
  for (const { frame, place } of elements) {
    if (!frame || y < frame.y || y > frame.y + frame.height) continue;
    const [pins, beside] =
      x < frame.x + frame.width / 2 ? [frame.inputs, x < frame.x] : [frame.outputs, x > frame.x + frame.width];
    const found = pins.find((each) => !each.power && Math.abs(each.y - y) <= NEAR);
    // Its own name is written in the frame.
    if (found && found.arg !== -1 && (beside || found.name !== "")) return { place, pin: found.arg };
  }
  return null;
}

/** The field of a pin: from the least to the most that it needs, and what is left of the drawing besides, its number and marks. */
const [LEAST, MOST, BESIDE] = [80, 160, 52];

/** Where the field of a pin is drawn: beside its box, which says what the pin is. */
export function spotOfPin({ elements }: Drawing, place: Place, pin: number) {
  const drawn: Drawn | undefined = elements.find((each) => each.place.join() === place.join());
  const frame: Frame | null = drawn?.frame ?? null;
  const input = frame?.inputs.find(({ arg }) => arg === pin);
  const output = frame?.outputs.find(({ arg }) => arg === pin);
  if (!frame || !(input ?? output)) return null;
  if (!input) return { x: frame.x + frame.width + 12, y: (output?.y ?? 0) + 4, width: MOST };
  const right = frame.x - 12;
  const width = Math.max(LEAST, Math.min(MOST, right + BESIDE));
  return { x: right - width, y: input.y + 4, width };
}

/** The first pin of a box that nothing is connected to. */
export function openPin({ result, args }: Box): number | null {
  if (result === NOTHING) return RESULT;
  const index = args.findIndex(({ value }) => value === NOTHING);
  return index < 0 ? null : index;
}

/** The box with a value at a pin; null where the text is no one value there. */
export function withPinValue(box: Box, pin: number, typed: string): Box | null {
  const value = typed.trim();
  if (!isOnePiece(value)) return null;
  const args = box.args.map((each, index) => (index === pin ? { ...each, value, branch: null } : each));
  const made: Box = pin === RESULT ? { ...box, result: value } : { ...box, args };
  const read = elementOf("box", writeElement(made));
  const same = read?.kind === "box" && read.args.length === args.length && read.callee === box.callee;
  return same && read.args.every(({ name, out }, index) => name === args[index]?.name && out === args[index]?.out)
    ? read
    : null;
}

/** The field of a pin. `put` is the edit with a different box. */
export function pinNaming(box: Box, pin: number, put: (box: Box) => Edit): Naming | null {
  const arg = box.args[pin];
  if (pin !== RESULT && !arg) return null;
  const written = pin === RESULT ? (box.result ?? "") : arg ? writeArgument({ ...arg, name: null }) : "";
  const taken = withDeclared((typed) => {
    const made = withPinValue(box, pin, typed);
    return made && put(made);
  });
  return { value: written === NOTHING ? "" : written, offers: "value", pin, taken };
}
