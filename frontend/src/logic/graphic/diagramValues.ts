/**
 * What the wires of a diagram have, as far as the values of variables tell: a wire that a variable takes over, an output of a block,
 * and what BOOL functions and comparisons make of them. The rest is computed by the PLC only, and not known here (null).
 */

import { compared, valueBy } from "./condition";
import type { DiagramItem, DiagramPin } from "./diagram";
import { isVariable } from "./measure";
import type { Power } from "./power";

type Read = (variable: string) => string | null;

const COMPARED: Readonly<Record<string, string>> = { GT: ">", GE: ">=", EQ: "=", NE: "<>", LE: "<=", LT: "<" };
const BOOLS = ["AND", "OR", "XOR", ...Object.keys(COMPARED)];

const truthOf = (text: string | null): Power => (text === "TRUE" ? true : text === "FALSE" ? false : null);
const word = (truth: Power) => (truth === null ? null : truth ? "TRUE" : "FALSE");
const inverted = (text: string | null) => {
  const truth = truthOf(text);
  return word(truth === null ? null : !truth);
};

/** The variables whose values are read for a diagram. */
export function variablesIn(items: readonly DiagramItem[]): Set<string> {
  const found = new Set<string>();
  for (const { kind, callee, inputs, outputs } of items) {
    for (const { text } of inputs) if (isVariable(text)) found.add(text);
    for (const { name, target, wire } of outputs) {
      if (wire === null) found.add(target);
      if (kind === "box" && name !== "") found.add(`${callee}.${name}`);
    }
  }
  return found;
}

/** The text of each wire, by its key. */
export function wireValues(items: readonly DiagramItem[], read: Read): Map<string, string | null> {
  const values = new Map<string, string | null>();
  const taken = new Map<string, string>();
  for (const { kind, inputs, outputs } of items) {
    const [input] = inputs;
    const [output] = outputs;
    if (kind !== "value" || !input?.wire || input.negated || input.edge !== "" || !output) continue;
    if (output.wire === null && output.operator === "") taken.set(input.wire, output.target);
  }
  for (const [wire, target] of taken) values.set(wire, read(target));
  const pin = ({ text, wire, negated, edge }: DiagramPin): string | null => {
    if (edge !== "") return null;
    const value = wire === null ? valueBy(text, read) : (values.get(wire) ?? null);
    return negated ? inverted(value) : value;
  };
  for (const { kind, callee, inputs, outputs } of items)
    for (const { name, wire, negated } of outputs) {
      if (wire === null || (values.get(wire) ?? null) !== null) continue;
      const [first] = inputs;
      const value =
        name !== ""
          ? hasEnable(inputs)
            ? null
            : read(`${callee}.${name}`)
          : kind === "box"
            ? resultOf(callee, inputs, pin)
            : first
              ? pin(first)
              : null;
      values.set(wire, negated ? inverted(value) : value);
    }
  return values;
}

/** With EN it is not known whether the box was called: where it was not, its wires are FALSE or 0. */
const hasEnable = (inputs: DiagramItem["inputs"]) => inputs.some(({ name }) => name.toUpperCase() === "EN");

/** The result of a function; null where the PLC has to compute it. */
function resultOf(
  callee: string,
  inputs: DiagramItem["inputs"],
  pin: (pin: DiagramPin) => string | null,
): string | null {
  const name = callee.toUpperCase();
  if (hasEnable(inputs)) return null;
  const values = inputs.map(pin);
  const truths = values.map(truthOf);
  const [first = null, second = null] = values;
  if (name === "AND" || name === "OR") {
    const decides = name === "OR";
    if (truths.includes(decides)) return word(decides);
    return truths.includes(null) || truths.length === 0 ? null : word(!decides);
  }
  if (name === "XOR") return truths.includes(null) ? null : word(truths.filter(Boolean).length % 2 === 1);
  if (name === "MOVE") return first;
  const by = COMPARED[name];
  return by !== undefined && values.length === 2 ? word(compared(by, first, second)) : null;
}

/** The wires that are BOOL, as far as the text tells. */
export function boolWires(items: readonly DiagramItem[]): Set<string> {
  const found = new Set<string>();
  for (const { kind, callee, inputs, outputs } of items)
    for (const { name, wire, negated } of outputs) {
      if (wire === null) continue;
      const [input] = inputs;
      const function_ = name === "" && kind === "box" && BOOLS.includes(callee.toUpperCase());
      const passed = kind === "value" && input && (input.negated || input.edge !== "" || found.has(input.wire ?? ""));
      if (function_ || passed || negated || name.toUpperCase() === "ENO") found.add(wire);
    }
  return found;
}
