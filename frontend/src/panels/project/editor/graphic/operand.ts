/** What keys do with the variable of the element at the cursor: watch, force, who wrote it, who uses it, a different name. */

import type { Place } from "../../../../logic/graphic/ladderLayout";
import { inText } from "../../../../logic/graphic/places";
import { type DrawnPart, spotsOf } from "../../../../logic/graphic/sheet";
import { showWriter } from "../../../../store/past/writer";
import { currentText } from "../../../../store/plc/values";
import { showCrossReferences } from "../../../../store/project/cross";
import { forcedAt } from "../../../../store/watch/forces";
import { addToWatch, force, releaseForce } from "../../../../store/watch/watchlist";
import { pathsOf } from "../watchAction";
import { sameElement } from "./cursor";

/** A variable as it is written, and where. */
export interface Operand {
  name: string;
  line: number;
  column: number;
  /** It is the instance of a box, which has no value of its own. */
  instance: boolean;
}

const VARIABLE = /^%?[\p{L}_][\p{L}\p{N}_.]*(?:\[[\p{N}\s,-]+\][\p{L}\p{N}_.]*)*$/u;

/** The variable of an element: of a contact, a coil, a pin, an action, or the instance of a box. Null where there is none. */
export function operandAt(part: DrawnPart | undefined, place: Place): Operand | null {
  if (!part?.readable) return null;
  const found = writtenAt(part, place);
  if (!found || !VARIABLE.test(found.name)) return null;
  const at = part.found.text.indexOf(found.name, found.at);
  return at < 0 ? null : { name: found.name, instance: found.instance, ...inText(part, at) };
}

function writtenAt(part: DrawnPart, place: Place): { name: string; at: number; instance: boolean } | null {
  if (part.kind === "network") {
    const item = part.drawing?.elements.find((each) => each.place[0] === place[0])?.element.item;
    const pin = place[1] === undefined ? undefined : [...(item?.inputs ?? []), ...(item?.outputs ?? [])][place[1]];
    if (pin) return { name: "target" in pin ? pin.target : pin.text, at: pin.span.at, instance: false };
    return item?.kind === "box" && item.named ? { name: item.callee, at: item.named.at, instance: true } : null;
  }
  const element = spotsOf(part).find((each) => sameElement(each.place, place))?.element;
  const written = (key: string) => (element && key in element ? String(Reflect.get(element, key)) : "");
  const name = written("operand") || written("callee") || written("action");
  return element && name !== "" ? { name, at: element.span.at, instance: element.kind === "box" } : null;
}

/** What the menu does with a variable and no key does. */
export const FORCE = { true: "Force:TRUE", false: "Force:FALSE", release: "Force:release" };

/** What can be forced of the variable at a place. */
export interface Forcing {
  bool: boolean;
  forced: boolean;
}
export const NO_FORCING: Forcing = { bool: false, forced: false };

/** Where the program was not built there is nothing to force. A value that is not known yet may be a BOOL. */
export async function forcingAt(file: string, part: DrawnPart | undefined, place: Place): Promise<Forcing> {
  const operand = operandAt(part, place);
  if (!operand || operand.instance) return NO_FORCING;
  const [path] = await pathsOf(file, operand.line, [operand.name]);
  if (path === undefined) return NO_FORCING;
  return { bool: ["TRUE", "FALSE", ""].includes(currentText(path)), forced: forcedAt(path) !== undefined };
}

const KEYS: Record<string, (file: string, path: string, operand: Operand) => void> = {
  "ctrl+alt+w": (_, path) => addToWatch([path]),
  "ctrl+alt+f": (_, path) => void switchForce(path),
  [FORCE.true.toLowerCase()]: (_, path) => void force(path, path, "TRUE"),
  [FORCE.false.toLowerCase()]: (_, path) => void force(path, path, "FALSE"),
  [FORCE.release.toLowerCase()]: (_, path) => void releaseForce(path),
  "shift+f12": (_, path) => showWriter(path),
  "ctrl+alt+r": (file, path, { line, column }) => void showCrossReferences({ file, line, column }, path),
};

/** Does what a key does with a variable. False for other keys. */
export function pressOperand(key: string, file: string, part: DrawnPart | undefined, place: Place): boolean {
  const deed = KEYS[key.toLowerCase()];
  if (!deed) return false;
  const operand = operandAt(part, place);
  if (operand)
    void pathsOf(file, operand.line, [operand.name]).then(([path]) => path !== undefined && deed(file, path, operand));
  return true;
}

/** Forces a BOOL to its other value; what is forced is released. */
async function switchForce(path: string): Promise<void> {
  if (forcedAt(path)) return releaseForce(path);
  const other = { TRUE: "FALSE", FALSE: "TRUE" }[currentText(path)];
  if (other !== undefined) await force(path, path, other);
}
