/** The field in which an element is named: what it shows, and the element that a text means. */

import { writeElement } from "./args";
import { readRung } from "./ladderRead";
import { networksIn } from "./networks";
import type { Element } from "./tree";

const BRACKETS: Partial<Record<Element["kind"], readonly [string, string]>> = { contact: ["[", "]"], coil: ["(", ")"] };

/** Of a contact or coil the part between its brackets, `/stop`; of others all of it. */
export function fieldText(element: Exclude<Element, { kind: "parallel" }>): string {
  const text = writeElement(element);
  return BRACKETS[element.kind] ? text.slice(1, -1) : text;
}

/** The element that a text means in the place of one of this kind; null where it means none, or several. */
export function elementOf(kind: Element["kind"], text: string): Element | null {
  if (text.trim() === "") return null;
  const [before, after] = BRACKETS[kind] ?? ["", ""];
  const [found] = networksIn(`RUNG\n${before}${text.trim()}${after}\nEND_RUNG\n`);
  const read = found ? readRung(found) : null;
  if (read === null || read.kind === "unread" || read.path.length !== 1) return null;
  return read.path[0] ?? null;
}
