/** An edit of a rung, network or chart in its drawing: a different text for it, and what is named before that is written. */

import type { TextKey } from "../../text";
import type { Place } from "./ladderLayout";
import type { Span } from "./tree";

/** A function, a block or an instance that can be put in, as the server tells them. */
export interface Box {
  name: string;
  kind: "function" | "block" | "instance";
  /** Of an instance the name of its block. */
  type: string;
  inputs: readonly string[];
  outputs: readonly string[];
  /** Types of the inputs, then of the outputs; empty where a pin takes several. */
  types: readonly string[];
  /** Its arguments are written without names. */
  by_position: boolean;
  /** It takes more inputs than are named. */
  more: boolean;
  comment: string;
}

/** What edits need to know of the file around a part. */
export interface Around {
  boxes: readonly Box[];
  /** All names that the file mentions, in capitals: those of wires with their `#`. */
  names: ReadonlySet<string>;
}

/** What the field of an element offers. */
export type Offers = "bool" | "value" | "box" | "step" | "none";

/** The open field of an element. */
export interface Naming {
  /** What it shows at first. */
  value: string;
  offers: Offers;
  example?: string;
  /** The pin of a box in a rung that is named. */
  pin?: number;
  /** What of the head is named; an element without it. */
  head?: "label" | "title" | "comment";
  /** The edit with this text in the element; null where the text does not fit there. */
  taken: (typed: string, around: Around) => Edit | null;
}

export interface Edit {
  /** The text of the part, which is drawn while something is named, and else written. */
  text: string;
  /** Where the cursor is then. */
  place: Place;
  naming: Naming | null;
  /** Variables that are declared with it. */
  declares?: readonly Declared[];
}

/** What is not connected or written yet, and the key that opens its field. */
export interface Empty {
  place: Place;
  key: string;
}

export interface Declared {
  name: string;
  type: string;
}

/** Why an edit is not possible. */
export interface Refused {
  refused: TextKey;
}

export type Made = Edit | Refused | null;

/** A slice of a text that is replaced. */
export interface Change extends Span {
  text: string;
}

/** The text with slices replaced that do not overlap. */
export function changed(text: string, changes: readonly Change[]): string {
  let made = text;
  for (const { at, end, text: wanted } of [...changes].sort((a, b) => b.at - a.at))
    made = made.slice(0, at) + wanted + made.slice(end);
  return made;
}

/** A name with the first number that makes it new. */
export function newName(start: string, names: ReadonlySet<string>): string {
  for (let number = 1; ; number += 1) {
    const name = `${start}${number}`;
    if (!names.has(name.toUpperCase())) return name;
  }
}

/** The names in a text. */
export const namesIn = (text: string): ReadonlySet<string> =>
  new Set((text.match(/#?[\p{L}_][\p{L}\p{N}_]*/gu) ?? []).map((name) => name.toUpperCase()));

const IDENTIFIER = /^[\p{L}_][\p{L}\p{N}_]*$/u;
export const isName = (text: string) => IDENTIFIER.test(text);

/** Whether a text is something, and neither ends what it is put into nor begins a comment there. */
export const isOnePiece = (typed: string) =>
  typed !== "" && !/[;\n]|\/\/|\(\*|\/\*/.test(typed.replace(/'(?:\$.|[^'$])*'|"(?:\$.|[^"$])*"/g, ""));

/** `name : TYPE`, as it is typed into a field to declare a variable with it, and the mode before it; null for anything else. */
function declaredIn(typed: string): (Declared & { mode: string }) | null {
  const [, mode = "", name = "", type = ""] =
    /^\s*(\/\s*|[PNSR]\s+)?([\p{L}_][\p{L}\p{N}_]*)\s*:\s*([\p{L}_][^;:=]*?)\s*$/u.exec(typed) ?? [];
  return name === "" ? null : { mode, name, type };
}

/** What takes a name takes `name : TYPE` as well, and declares it. */
export const withDeclared =
  (take: Naming["taken"]): Naming["taken"] =>
  (typed, around) => {
    const declared = declaredIn(typed);
    if (!declared) return take(typed, around);
    const { mode, name, type } = declared;
    const edit = take(mode + name, around);
    return edit && { ...edit, declares: [{ name, type }] };
  };

/** The instances that a text declares of the blocks that are known. */
export function instancesIn(text: string, boxes: readonly Box[]): Box[] {
  const blocks = new Map(boxes.filter(({ kind }) => kind === "block").map((box) => [box.name.toUpperCase(), box]));
  return [
    ...text.matchAll(
      /([\p{L}_][\p{L}\p{N}_]*(?:\s*,\s*[\p{L}_][\p{L}\p{N}_]*)*)\s*:\s*([\p{L}_][\p{L}\p{N}_.]*)\s*[;:(]/gu,
    ),
  ].flatMap(([, names = "", type = ""]) => {
    const block = blocks.get(type.toUpperCase());
    if (!block) return [];
    return names.split(",").map((name): Box => ({ ...block, kind: "instance", name: name.trim(), type: block.name }));
  });
}
