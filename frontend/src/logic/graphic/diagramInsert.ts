/** Puts a box into a network: into the wire of an input, after an output, or after an item. */

import { NOTHING } from "./diagram";
import { type At, at, type Diagram, diagramOf, headOf, lineAfter, lineBefore, pinText } from "./diagramEdit";
import { type Around, type Box, type Change, changed, type Edit, newName } from "./edit";
import type { Place } from "./ladderLayout";

/** What is called, and how. */
export interface Call {
  box: Box;
  /** The name that is written: of a block that of its instance. */
  callee: string;
  enabled: boolean;
  /** Its arguments as they were typed; null where the box gives them. */
  given: string | null;
}

const gives = ({ box }: Call) => box.kind === "function" || box.outputs.length > 0;

/** The line of a call: its first input has `first`, and its result, or its first output, goes where `head` says (`x := `, `#a = `). */
function written(call: Call, first: string, head: string, target: string): string {
  const { box, callee, enabled } = call;
  const values = box.inputs.map((name, index) => [name, index === 0 ? first : NOTHING] as const);
  const plain = box.by_position && !enabled;
  const args = plain ? values.map(([, value]) => value) : values.map(([name, value]) => `${name} := ${value}`);
  if (enabled) args.unshift(`EN := ${NOTHING}`);
  const whole = call.given === null ? args.join(", ") : call.given;
  if (box.kind === "function") return `${head}${callee}(${whole})`;
  const out = target === "" || call.given?.includes("=>") ? "" : `${box.outputs[0]} => ${target}`;
  return `${callee}(${[whole, out].filter(Boolean).join(", ")})`;
}

const headFor = (target: string) => (target === "" ? "" : target.startsWith("#") ? `${target} = ` : `${target} := `);

export function insertBox(diagram: Diagram, place: Place, call: Call, around: Around): Edit | null {
  const found = at(diagram, place);
  const wire = newName("#w", around.names);
  const made = !found
    ? after(diagram, diagram.items.length - 1, NOTHING, call, wire)
    : found.input || found.item.kind !== "box"
      ? intoInput(diagram, found, call, wire)
      : found.output
        ? behindOutput(diagram, found, call, wire, newName("#w", new Set([...around.names, wire.toUpperCase()])))
        : after(diagram, found.index, found.item.outputs[0]?.target ?? NOTHING, call, wire);
  const text = changed(diagram.text, made.changes);
  const read = diagramOf(text);
  const item = read?.items[made.index];
  if (!read || read.items.length !== diagram.items.length + made.lines || item?.kind !== "box") return null;
  const pin = item.inputs.findIndex((each) => each.text === NOTHING);
  return { text, place: pin < 0 ? [made.index] : [made.index, pin], naming: null };
}

interface Inserted {
  changes: readonly Change[];
  /** That of the new box. */
  index: number;
  /** How many are new. */
  lines: number;
}

function after(diagram: Diagram, index: number, first: string, call: Call, wire: string): Inserted {
  // An output of a block that nobody reads needs no wire: a line that reads it comes with one.
  const line = written(call, first, headFor(wire), "");
  return { changes: [lineAfter(diagram, index, line)], index: index + 1, lines: 1 };
}

function intoInput(diagram: Diagram, { item, index, ...found }: At, call: Call, wire: string): Inserted {
  const pin = found.input ?? item.inputs[0];
  const line = written(call, pin?.text ?? NOTHING, headFor(wire), wire);
  const changes = [lineBefore(diagram, index, line)];
  if (pin && gives(call)) changes.push({ ...pin.span, text: pinText({ ...pin, text: wire }) });
  return { changes, index, lines: 1 };
}

function behindOutput(diagram: Diagram, found: At, call: Call, wire: string, second: string): Inserted {
  const { item, index, output } = found;
  if (!output || !gives(call)) return after(diagram, index, output?.target ?? NOTHING, call, wire);
  const head = headOf(item);
  const result = output.arg === null;
  const before = result ? diagram.text.slice(head.at, head.end) : headFor(output.target);
  const change = result ? { ...head, text: `${wire} = ` } : { ...output.span, text: wire };
  const plain = output.operator === "" && !/^[^=]*:[^=]/.test(before);
  if (call.box.kind === "function" || plain) {
    const line = written(call, wire, before, output.target);
    return { changes: [change, lineAfter(diagram, index, line)], index: index + 1, lines: 1 };
  }
  const block = written(call, wire, "", second);
  const { at, end, text } = lineAfter(diagram, index, block);
  const more = lineAfter(diagram, index, `${before}${second}`).text;
  return { changes: [change, { at, end, text: text + more }], index: index + 1, lines: 2 };
}
