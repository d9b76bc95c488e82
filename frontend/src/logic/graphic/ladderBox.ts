/** A box that is put into a rung: a function, an instance, or a block, whose instance is named next. */

import { NOTHING } from "./diagram";
import { type Around, isName, type Box as Known, type Naming, newName } from "./edit";
import { elementOf } from "./field";
import type { Argument, Box } from "./tree";

const NOWHERE = { at: 0, end: 0 };
const POWER = "~";

const isNamed = (wanted: string) => (box: Known) => box.name.toUpperCase() === wanted.trim().toUpperCase();
const argument = (name: string, value: string): Argument => ({ name, out: false, value, branch: null, span: NOWHERE });

/** The pin of a block that the power goes to, or goes on from: its first one of BOOL. */
const boolPin = (names: readonly string[], types: readonly string[]) =>
  names.find((_, index) => types[index] === "BOOL") ?? null;

/** The call with the power at its first input of BOOL, at EN where it has none, or where that is wanted; other inputs are not connected. */
export function callOf(known: Known, callee: string, enabled: boolean): Box {
  const { kind, inputs, outputs, types } = known;
  const power = kind === "function" || enabled ? null : boolPin(inputs, types);
  const args = inputs.map((name) => argument(name, name === power ? POWER : NOTHING));
  if (power === null) args.unshift(argument("EN", POWER));
  const output = power === null ? "ENO" : boolPin(outputs, types.slice(inputs.length));
  const result = kind === "function" ? NOTHING : null;
  return { kind: "box", result, callee, args, output, span: NOWHERE };
}

/** The field of a new box. `put` is the edit that puts an element in; `empty` is drawn until it has a name. */
export function boxNaming(put: (box: Box) => ReturnType<Naming["taken"]>, enabled: boolean): Naming {
  const taken: Naming["taken"] = (typed, around) => {
    const known = around.boxes.find(isNamed(typed));
    if (known)
      return known.kind === "block" ? instance(put, known, enabled, around) : put(callOf(known, known.name, enabled));
    const read = elementOf("box", typed);
    return read?.kind === "box" ? put(read) : null;
  };
  return { value: "", offers: "box", example: "TON, timer(IN := ~)", taken };
}

/** The field for the instance of a block, which is declared with it. */
function instance(put: (box: Box) => ReturnType<Naming["taken"]>, block: Known, enabled: boolean, around: Around) {
  const suggested = newName(block.name.toLowerCase().replace(/^fb_?/, ""), around.names);
  const made = put(callOf(block, suggested, enabled));
  const taken: Naming["taken"] = (typed, now) => {
    const callee = typed.trim();
    if (!isName(callee)) return null;
    const known = now.boxes.find(isNamed(callee));
    if (known && known.type.toUpperCase() !== block.name.toUpperCase()) return null;
    const edit = put(callOf(block, callee, enabled));
    return edit && (known ? edit : { ...edit, declares: [{ name: callee, type: block.name }] });
  };
  return made && { ...made, naming: { value: suggested, offers: "none" as const, taken } };
}
