/** The field in which an element is named: what it shows, and the element that a text means. */

import { writeElement } from "./args";
import { readRung } from "./ladderRead";
import { networksIn } from "./networks";
import type { Element } from "./tree";

const BRACKETS: Partial<Record<Element["kind"], readonly [string, string]>> = {
  contact: ["[", "]"],
  coil: ["(", ")"],
  send: ["-> #", ""],
  receive: ["#", ""],
  jump: ["JMP ", ""],
};

/** Of a contact or coil the part between its brackets, `/stop`; of a link or jump its name; of a box all of it. */
export function fieldText(element: Exclude<Element, { kind: "parallel" }>): string {
  const text = writeElement(element);
  const [before, after] = BRACKETS[element.kind] ?? ["", ""];
  return text.startsWith(before) ? text.slice(before.length, text.length - after.length) : text;
}

/** The element that a text means in the place of one of this kind; null where it means none, or several. */
export function elementOf(kind: Element["kind"], text: string): Element | null {
  if (text.trim() === "") return null;
  const written = kind === "jump" && /^\s*RETURN\s*$/i.test(text) ? "box" : kind;
  const [before, after] = BRACKETS[written] ?? ["", ""];
  const [found] = networksIn(`RUNG\n${before}${text.trim()}${after}\nEND_RUNG\n`);
  const read = found ? readRung(found) : null;
  if (read === null || read.kind === "unread" || read.path.length !== 1) return null;
  return read.path[0] ?? null;
}
