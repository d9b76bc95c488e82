/**
 * Where power flows in a rung, computed from the values of its variables. An edge contact remembers what it saw, and an expression is
 * computed by the PLC only: values do not tell whether these are closed, so what comes after them is not known (null).
 */

import type { Box, Contact } from "./tree";

/** A place on the wires of a rung. `from` are indexes of nodes before it. */
export type PowerNode =
  | { kind: "rail" }
  | { kind: "contact"; from: number; contact: Contact }
  | { kind: "box"; from: number; box: Box }
  | { kind: "join"; from: readonly number[] }
  | { kind: "receive"; from: number; name: string }
  | { kind: "end" };

export type Power = boolean | null;

const and = (a: Power, b: Power): Power =>
  a === false || b === false ? false : a === null || b === null ? null : true;

const or = (all: readonly Power[]): Power => (all.includes(true) ? true : all.includes(null) ? null : false);

/** Whether a contact lets power through; null when its value does not tell. */
export function closedBy({ mode, operand }: Contact, read: (operand: string) => Power): Power {
  if (mode === "P" || mode === "N") return null;
  const value = read(operand);
  return value === null ? null : mode === "/" ? !value : value;
}

/**
 * The power at each node. `read` gives the value of a BOOL variable as it is written, null when it is not known; `sends` names the
 * nodes that send power to a link.
 */
export function powerOf(
  nodes: readonly PowerNode[],
  sends: ReadonlyMap<string, readonly number[]>,
  read: (operand: string) => Power,
): Power[] {
  const power: Power[] = [];
  const at = (index: number): Power => power[index] ?? null;
  for (const node of nodes) {
    switch (node.kind) {
      case "rail":
        power.push(true);
        break;
      case "end":
        power.push(false);
        break;
      case "contact":
        power.push(and(at(node.from), closedBy(node.contact, read)));
        break;
      case "join":
        power.push(or(node.from.map(at)));
        break;
      case "receive":
        // Nodes are in the order of the text, so what sends to this one has its power already; a link reads the power sent above.
        power.push(and(at(node.from), or((sends.get(node.name.toUpperCase()) ?? []).map(at))));
        break;
      case "box":
        power.push(after(node.box, at(node.from), read));
    }
  }
  return power;
}

/**
 * The power after a box: that of its output, if the call says which; the result of a function is known to the PLC only. A box that EN
 * keeps from being called lets none through, whatever its output still has.
 */
function after({ callee, result, output, args }: Box, power: Power, read: (operand: string) => Power): Power {
  if (output === null) return power;
  const enable = args.find(({ name, out }) => !out && name?.toUpperCase() === "EN");
  const enabled = !enable || (enable.value === "~" ? power : enable.branch ? null : read(enable.value));
  if (result !== null || output.toUpperCase() === "ENO") return enabled === false ? false : null;
  return and(enabled, read(`${callee}.${output}`));
}
