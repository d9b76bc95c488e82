/** Edits of drawings as edits of the text: with undo, the carets of others, and everything else that it has. */

import { declarations } from "../../../../logic/graphic/declare";
import type { Change, Declared } from "../../../../logic/graphic/edit";
import type { Found } from "../../../../logic/graphic/networks";
import { useDocuments } from "../../../../store/project/documents";
import { modelOf } from "../models";

const modelAt = (path: string) => modelOf(path, useDocuments.getState().open[path]?.text ?? "");

/** What is the same at both ends of a change stays, so that breakpoints and carets there keep their places. All changes are taken back together. */
function changeText(path: string, changes: readonly Change[]): void {
  const model = modelAt(path);
  const whole = model.getValue();
  const edits = changes.map(({ at, end, text }) => {
    const old = whole.slice(at, end);
    const head = same(old, text);
    const tail = same([...old.slice(head)].reverse().join(""), [...text.slice(head)].reverse().join(""));
    const [start, stop] = [model.getPositionAt(at + head), model.getPositionAt(end - tail)];
    const range = {
      startLineNumber: start.lineNumber,
      startColumn: start.column,
      endLineNumber: stop.lineNumber,
      endColumn: stop.column,
    };
    return { range, text: text.slice(head, text.length - tail) };
  });
  model.pushStackElement();
  model.pushEditOperations([], edits, () => null);
  model.pushStackElement();
}

/** How many characters two texts begin with in common. */
function same(a: string, b: string): number {
  let count = 0;
  while (count < a.length && a[count] === b[count]) count += 1;
  return count;
}

/** A different text for a part, and declarations in its POU. */
export function writePart(path: string, { from, to }: Found, text: string, declares: readonly Declared[] = []): void {
  const whole = modelAt(path).getValue();
  changeText(path, [...declarations(whole, from, declares), { at: from, end: to, text }]);
}

/** An empty rung or network below this one, or above. */
export function addPart(path: string, found: Found, above: boolean): void {
  const { kind, to, indent } = found;
  const word = kind === "network" ? "NETWORK" : "RUNG";
  const text = `${word}\n${indent}END_${word}`;
  const at = above ? beginOf(path, found) : to;
  changeText(path, [{ at, end: at, text: above ? `${text}\n${indent}` : `\n${indent}${text}` }]);
}

/** Networks below this one. */
export function putParts(path: string, { to, indent }: Found, networks: readonly string[]): void {
  const lines = networks.flatMap((text) => text.split("\n"));
  changeText(path, [{ at: to, end: to, text: lines.map((line) => `\n${line === "" ? "" : indent}${line}`).join("") }]);
}

/** Comments a network out with `{off}`, or in again. */
export function switchPart(path: string, found: Found): void {
  const at = beginOf(path, found);
  changeText(path, [{ at, end: found.from, text: found.head.off ? "" : "{off} " }]);
}

/** Where a part begins with its pragma. */
const beginOf = (path: string, { from, head }: Found) =>
  head.off ? modelAt(path).getValue().lastIndexOf("{", from) : from;

/** Without a part, and the line that is empty then. */
export function removePart(path: string, found: Found): void {
  const whole = modelAt(path).getValue();
  const { to } = found;
  const from = beginOf(path, found);
  const start = whole.lastIndexOf("\n", from - 1) + 1;
  const empty = whole.slice(start, from).trim() === "" && /^[ \t]*(?:\n|$)/.test(whole.slice(to));
  const end = empty ? whole.indexOf("\n", to) + 1 || whole.length : to;
  changeText(path, [{ at: empty ? start : from, end, text: "" }]);
}

export function takeBack(path: string, again: boolean): void {
  const model = modelAt(path);
  void (again ? model.redo() : model.undo());
}
