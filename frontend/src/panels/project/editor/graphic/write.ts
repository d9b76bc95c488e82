/** Edits of rungs as edits of the text: with undo, the carets of others, and everything else that it has. */

import { writeRung } from "../../../../logic/graphic/ladderWrite";
import type { Found } from "../../../../logic/graphic/networks";
import type { Path } from "../../../../logic/graphic/tree";
import { useDocuments } from "../../../../store/project/documents";
import { modelOf } from "../models";

function replaceText(path: string, from: number, to: number, text: string): void {
  const model = modelOf(path, useDocuments.getState().open[path]?.text ?? "");
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

export const writePath = (path: string, { head, from, to, indent }: Found, elements: Path): void =>
  replaceText(path, from, to, writeRung(head, elements, indent));

/** An empty rung below this one. */
export const addRungBelow = (path: string, { to, indent }: Found): void =>
  replaceText(path, to, to, `\n${indent}${writeRung({ label: "", title: "", comment: [], off: false }, [], indent)}`);

export function takeBack(path: string, again: boolean): void {
  const model = modelOf(path, useDocuments.getState().open[path]?.text ?? "");
  void (again ? model.redo() : model.undo());
}
