/** Edits of a function block diagram: each is a change of the lines that it concerns, and leaves the order of the others. */

import type { DiagramInput, DiagramItem, DiagramOutput, DiagramPin } from "./diagram";
import { readDiagram, readPin } from "./diagramRead";
import { type Change, changed } from "./edit";
import type { Place } from "./ladderLayout";
import { lineStartOf, networksIn } from "./networks";

/** A network as it is edited. */
export interface Diagram {
  text: string;
  items: readonly DiagramItem[];
  /** Where the first item is put in. */
  body: number;
}

/** Reads the text of one network; null where it cannot be read. */
export function diagramOf(text: string): Diagram | null {
  const [found] = networksIn(text);
  const read = found ? readDiagram(found) : null;
  return found && read?.kind === "network" ? { text, items: read.items, body: found.body.at } : null;
}

/** What is at a place: an item, and perhaps one of its pins. */
export interface At {
  index: number;
  item: DiagramItem;
  input: DiagramInput | null;
  output: DiagramOutput | null;
}

export function at({ items }: Diagram, [index, pin]: Place): At | null {
  const item = index === undefined ? undefined : items[index];
  if (index === undefined || !item) return null;
  const input = pin === undefined ? null : (item.inputs[pin] ?? null);
  const output = pin === undefined ? null : (item.outputs[pin - item.inputs.length] ?? null);
  return { index, item, input, output };
}

export const blanksAt = (text: string, at: number) => /^[ \t]*/.exec(text.slice(lineStartOf(text, at)))?.[0] ?? "";

/** The end of an item with its `;` and a comment in the same line, and whether the line ends there. */
function lineEnd(text: string, { span }: DiagramItem): { end: number; last: boolean } {
  const semicolon = text.indexOf(";", span.end) + 1;
  const rest = /^[ \t]*(?:\/\/[^\n]*|\(\*[^\n]*?\*\)[ \t]*)?(?=\n|$)/.exec(text.slice(semicolon));
  return { end: semicolon + (rest?.[0].length ?? 0), last: rest !== null };
}

/** The change that puts a line after an item; with -1 before the first one, or into an empty network. */
export function lineAfter({ text, items, body }: Diagram, index: number, line: string): Change {
  const item = items[index];
  if (item) {
    const { end } = lineEnd(text, item);
    return { at: end, end, text: `\n${blanksAt(text, item.span.at)}${line};` };
  }
  const [first] = items;
  const blanks = first ? blanksAt(text, first.span.at) : `${blanksAt(text, text.length)}    `;
  return { at: body, end: body, text: `\n${blanks}${line};` };
}

export function lineBefore({ text, items }: Diagram, index: number, line: string): Change {
  const { at = 0 } = items[index]?.span ?? {};
  const alone = text.slice(lineStartOf(text, at), at).trim() === "";
  return { at, end: at, text: alone ? `${line};\n${blanksAt(text, at)}` : `${line}; ` };
}

export const pinText = ({ negated, edge, text }: Pick<DiagramPin, "negated" | "edge" | "text">) =>
  `${negated ? "NOT " : ""}${edge === "" ? "" : edge === "P" ? "R_EDGE " : "F_EDGE "}${text}`;

/** The text with a different pin. */
export const withPin = (text: string, { span }: DiagramPin, pin: Pick<DiagramPin, "negated" | "edge" | "text">) =>
  changed(text, [{ ...span, text: pinText(pin) }]);

/** The pin negated, or no longer. What is no variable or wire gets brackets. */
export function negatedPin(pin: DiagramPin): Pick<DiagramPin, "negated" | "edge" | "text"> {
  if (pin.negated || pin.edge !== "") return { ...pin, negated: !pin.negated };
  const [, inner] = /^NOT\s*\(([\s\S]*)\)$/i.exec(pin.text) ?? [];
  if (inner !== undefined) return { ...pin, text: inner };
  const simple = readPin(`NOT ${pin.text}`, pin.span).negated;
  return simple ? { ...pin, negated: true } : { ...pin, text: `NOT (${pin.text})` };
}

const EDGES = ["", "P", "N"] as const;
export const nextPinEdge = (pin: DiagramPin) => ({
  ...pin,
  edge: EDGES[(EDGES.indexOf(pin.edge) + 1) % EDGES.length] ?? ("" as const),
});

/** The text without an item. */
export function withoutItem(text: string, item: DiagramItem): string {
  const { span } = item;
  const from = lineStartOf(text, span.at);
  const { end, last } = lineEnd(text, item);
  if (last && text.slice(from, span.at).trim() === "") return text.slice(0, from - 1) + text.slice(end);
  const behind = /^[ \t]*/.exec(text.slice(end))?.[0].length ?? 0;
  if (!last) return text.slice(0, span.at) + text.slice(end + behind);
  return text.slice(0, span.at).trimEnd() + text.slice(text.indexOf(";", span.end) + 1);
}

/** Without an argument, and the comma beside it. */
export function withoutArgument(
  text: string,
  { args, inputs, outputs }: DiagramItem,
  pin: DiagramInput | DiagramOutput,
) {
  const { arg } = pin;
  if (!arg) return null;
  // What is no argument is the condition of a jump.
  if (!args) return text.slice(0, arg.at).replace(/\s+IF\s+$/i, "") + text.slice(arg.end);
  const all = [...inputs, ...outputs].flatMap((each) => (each.arg ? [each.arg] : [])).sort((a, b) => a.at - b.at);
  const index = all.findIndex((each) => each.at === arg.at);
  const [before, after] = [all[index - 1], all[index + 1]];
  if (after) return text.slice(0, arg.at) + text.slice(after.at);
  return text.slice(0, before ? before.end : args.at) + text.slice(args.end);
}

/** With one more argument at the end. */
export function withArgument(text: string, { args, inputs, outputs }: DiagramItem, argument: string): string {
  if (!args) return text;
  const any = inputs.length > 0 || outputs.some(({ arg }) => arg);
  const end = args.at + text.slice(args.at, args.end).trimEnd().length;
  return `${text.slice(0, end)}${any ? ", " : ""}${argument}${text.slice(args.end)}`;
}

/** With an item and its neighbour in each other's place; what is between them stays. */
export function swapped(text: string, first: DiagramItem, second: DiagramItem): string {
  const written = ({ span }: DiagramItem) => text.slice(span.at, span.end);
  return changed(text, [
    { ...first.span, text: written(second) },
    { ...second.span, text: written(first) },
  ]);
}

/** The line at one place of the order of execution in a different one; the lines between move by one. */
export function reordered(text: string, from: number, to: number): string {
  let made = text;
  for (let at = from; at !== to; at += to > from ? 1 : -1) {
    const items = diagramOf(made)?.items ?? [];
    const [first, second] = [
      items[Math.min(at, at + (to > from ? 1 : -1))],
      items[Math.max(at, at + (to > from ? 1 : -1))],
    ];
    if (first && second) made = swapped(made, first, second);
  }
  return made;
}

/** What is before the value of an item: its target with `:=`, `S=` or `=`, and perhaps a type. */
export function headOf({ span, named, inputs }: DiagramItem): { at: number; end: number } {
  return { at: span.at, end: named?.at ?? inputs[0]?.span.at ?? span.at };
}

/** The wires that the text of a network sets, as they are written. */
export function wiresIn(text: string): string[] {
  const outputs = diagramOf(text)?.items.flatMap((item) => item.outputs) ?? [];
  return [...new Set(outputs.flatMap(({ target, wire }) => (wire === null ? [] : [target])))];
}
