/** Edits of drawings as edits of the text: with undo, the carets of others, and everything else that it has. */

import type { TextEdit } from "vscode-languageserver-types";
import { wholeText } from "../../../../logic/graphic/clip";
import { declarations } from "../../../../logic/graphic/declare";
import type { Change, Declared } from "../../../../logic/graphic/edit";
import { bodiesOf, type Found } from "../../../../logic/graphic/networks";
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

/** Different texts for several parts, taken back together. */
export function writeParts(path: string, written: readonly { found: Found; text: string }[]): void {
  changeText(
    path,
    written.map(({ found, text }) => ({ at: found.from, end: found.to, text })),
  );
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

/** A rung or network above or below a different one, which may be in a different body. Its number then. */
export function movePart(
  path: string,
  parts: readonly { found: Found }[],
  from: number,
  { rung, above }: { rung: number; above: boolean },
): number {
  const [source, target] = [parts[from]?.found, parts[rung]?.found];
  if (!source || !target || from === rung || (above ? from + 1 : from - 1) === rung) return from;
  const whole = modelAt(path).getValue();
  const alone = bodiesOf(whole).some((body) => body.length === 1 && body[0]?.from === source.from);
  const lines = wholeText(source).split("\n");
  const text = lines.map((line, index) => (index === 0 || line === "" ? line : target.indent + line)).join("\n");
  const at = above ? beginOf(path, target) : target.to;
  const put = { at, end: at, text: above ? `${text}\n${target.indent}` : `\n${target.indent}${text}` };
  changeText(path, [alone ? emptying(source) : removal(path, source), put]);
  return rung + (above ? 0 : 1) - (from < rung && !alone ? 1 : 0);
}

/** Comments networks out with `{off}`; those that all are so, in again. */
export function switchParts(path: string, parts: readonly Found[]): void {
  const off = parts.every(({ head }) => head.off);
  const changing = parts.filter(({ head }) => head.off === off);
  changeText(
    path,
    changing.map((found) => ({ at: beginOf(path, found), end: found.from, text: off ? "" : "{off} " })),
  );
}

/** Where a part begins with its pragma. */
const beginOf = (path: string, { from, head }: Found) =>
  head.off ? modelAt(path).getValue().lastIndexOf("{", from) : from;

/** Without parts. Of a body that would have none left the first is emptied: a body without networks is no drawing. */
export function removeParts(path: string, gone: readonly Found[]): void {
  const whole = modelAt(path).getValue();
  const isGone = ({ from }: Found) => gone.some((each) => each.from === from);
  const emptied = bodiesOf(whole).flatMap((body) => (body.every(isGone) ? body.slice(0, 1) : []));
  changeText(
    path,
    gone.map((found) => (emptied.some(({ from }) => from === found.from) ? emptying(found) : removal(path, found))),
  );
}

function emptying({ kind, from, to, indent }: Found): Change {
  const word = kind === "network" ? "NETWORK" : "RUNG";
  return { at: from, end: to, text: `${word}\n${indent}END_${word}` };
}

/** The text of a part goes, and the line that is empty then. */
function removal(path: string, found: Found): Change {
  const whole = modelAt(path).getValue();
  const { to } = found;
  const from = beginOf(path, found);
  const start = whole.lastIndexOf("\n", from - 1) + 1;
  const empty = whole.slice(start, from).trim() === "" && /^[ \t]*(?:\n|$)/.test(whole.slice(to));
  const end = empty ? whole.indexOf("\n", to) + 1 || whole.length : to;
  return { at: empty ? start : from, end, text: "" };
}

/** What the language server would change. */
export function applyEdits(path: string, edits: readonly TextEdit[]): void {
  const model = modelAt(path);
  const offset = ({ line, character }: TextEdit["range"]["start"]) =>
    model.getOffsetAt({ lineNumber: line + 1, column: character + 1 });
  changeText(
    path,
    edits.map(({ range, newText }) => ({ at: offset(range.start), end: offset(range.end), text: newText })),
  );
}

export function takeBack(path: string, again: boolean): void {
  const model = modelAt(path);
  void (again ? model.redo() : model.undo());
}
