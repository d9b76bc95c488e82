/** Declares variables in the POU that a part of its body is in. */

import type { Change, Declared } from "./edit";
import { lineStartOf } from "./networks";
import { wordsIn } from "./reader";

const POUS = ["PROGRAM", "FUNCTION_BLOCK", "FUNCTION", "CLASS"];

/** The changes of a text that declare variables in the POU at an offset: in its last VAR section, else in a new one before the body. */
export function declarations(text: string, at: number, wanted: readonly Declared[]): Change[] {
  if (wanted.length === 0) return [];
  let [pou, open, end] = [0, false, null as number | null];
  for (const { word, at: here } of wordsIn(text, 0, at)) {
    if (POUS.includes(word)) [pou, open, end] = [here, false, null];
    else if (word === "VAR") open = isPlain(text, here);
    else if (word.startsWith("VAR_")) open = false;
    else if (word === "END_VAR" && open) [end, open] = [here, false];
  }
  const blanks = /^[ \t]*/.exec(text.slice(lineStartOf(text, at)))?.[0] ?? "";
  const lines = wanted.map(({ name, type }) => `${name} : ${type};`);
  if (end === null) {
    const body = bodyOf(text, pou, at);
    const section = ["VAR", ...lines.map((line) => `    ${line}`), "END_VAR"];
    return [{ at: body, end: body, text: section.map((line) => `${blanks}${line}\n`).join("") }];
  }
  const start = lineStartOf(text, end);
  // The section is written on one line.
  if (text.slice(start, end).trim() !== "") return [{ at: end, end, text: `${lines.join(" ")} ` }];
  const indent = `${text.slice(start, end)}    `;
  return [{ at: start, end: start, text: lines.map((line) => `${indent}${line}\n`).join("") }];
}

/** `VAR` without CONSTANT and the like, which variables of a drawing must not be. */
const isPlain = (text: string, at: number) =>
  !/^VAR\s+(?:CONSTANT|RETAIN|NON_RETAIN|PERSISTENT)\b/i.test(text.slice(at, at + 40));

/** The line after the declarations of a POU: after its last section, else after its first line. */
function bodyOf(text: string, pou: number, at: number): number {
  let last = pou;
  for (const { word, at: here } of wordsIn(text, pou, at)) if (word === "END_VAR") last = here;
  const line = text.indexOf("\n", last);
  return line < 0 || line >= at ? lineStartOf(text, at) : line + 1;
}
