/** Edits of rungs as edits of the text: with undo, the carets of others, and everything else that it has. */

import { writeRung } from "../../../../logic/graphic/ladderWrite";
import type { Found } from "../../../../logic/graphic/networks";
import type { Path } from "../../../../logic/graphic/tree";
import { useDocuments } from "../../../../store/project/documents";
import { modelOf } from "../models";

/** What is the same at both ends stays, so that breakpoints and carets there keep their places. */
function replaceText(path: string, first: number, last: number, wanted: string): void {
  const model = modelOf(path, useDocuments.getState().open[path]?.text ?? "");
  const old = model.getValue().slice(first, last);
  const head = same(old, wanted);
  const tail = same([...old.slice(head)].reverse().join(""), [...wanted.slice(head)].reverse().join(""));
  const [from, to, text] = [first + head, last - tail, wanted.slice(head, wanted.length - tail)];
  const [start, end] = [model.getPositionAt(from), model.getPositionAt(to)];
  const range = {
    startLineNumber: start.lineNumber,
    startColumn: start.column,
    endLineNumber: end.lineNumber,
    endColumn: end.column,
  };
  model.pushStackElement();
  model.pushEditOperations([], [{ range, text }], () => null);
  model.pushStackElement();
}

/** How many characters two texts begin with in common. */
function same(a: string, b: string): number {
  let count = 0;
  while (count < a.length && a[count] === b[count]) count += 1;
  return count;
}

export const writePath = (path: string, { head, from, to, indent }: Found, elements: Path): void =>
  replaceText(path, from, to, writeRung(head, elements, indent));

/** An empty rung below this one. */
export const addRungBelow = (path: string, { to, indent }: Found): void =>
  replaceText(path, to, to, `\n${indent}${writeRung({ label: "", title: "", comment: [], off: false }, [], indent)}`);

export function takeBack(path: string, again: boolean): void {
  const model = modelOf(path, useDocuments.getState().open[path]?.text ?? "");
  void (again ? model.redo() : model.undo());
}
