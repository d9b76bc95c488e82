/**
 * Writes a rung as text: a parallel has one line a branch, a rung without one stays on its line up to 100 characters, and the pins of
 * a box that does not fit have a line each. What was read from such a text is written with the same characters.
 */

import { boxEnd, boxStart, writeArgument, writeElement } from "./args";
import type { Box, Head, Parallel, Path } from "./tree";

const WIDTH = 100;
const STEP = "    ";

/** The text of a rung from its first word to its last, for a place with this indentation. */
export function writeRung(head: Head, path: Path, indent: string): string {
  const first = writeHead("RUNG", head, indent);
  const body = writePath(path, indent + STEP).map((line) => `${line}\n`);
  return `${first}${body.join("")}${indent}END_RUNG`;
}

/** The first line of a network and its comment, with the line break after them. */
export function writeHead(word: string, { label, title, comment }: Head, indent: string): string {
  const named = label === "" ? "" : ` ${label}:`;
  const titled = title === "" ? "" : ` "${title.replace(/[$"]/g, "$$$&")}"`;
  const below = comment.map((line) => `${indent}${STEP}//${line === "" ? "" : ` ${line}`}\n`);
  return `${word}${named}${titled}\n${below.join("")}`;
}

/** The lines of a path. Elements share a line until a parallel, which begins and ends lines of its own. */
function writePath(path: Path, indent: string): string[] {
  const lines: string[] = [];
  let line = "";
  for (const element of path) {
    if (element.kind === "parallel") {
      const written = writeParallel(element, indent);
      if (line !== "") lines.push(indent + line);
      lines.push(...written.slice(0, -1));
      line = (written.at(-1) ?? "").slice(indent.length);
      continue;
    }
    const short = writeElement(element);
    const joined = line === "" ? short : `${line} ${short}`;
    if (indent.length + joined.length <= WIDTH || (line === "" && element.kind !== "box")) {
      line = joined;
      continue;
    }
    if (element.kind === "box" && indent.length + short.length > WIDTH) {
      const wrapped = writeWrapped(element, indent);
      const begins = line === "" ? (wrapped[0] ?? "") : `${indent}${line} ${(wrapped[0] ?? "").trimStart()}`;
      lines.push(begins, ...wrapped.slice(1, -1));
      line = (wrapped.at(-1) ?? "").slice(indent.length);
      continue;
    }
    lines.push(indent + line);
    line = short;
  }
  if (line !== "") lines.push(indent + line);
  return lines;
}

function writeParallel({ branches }: Parallel, indent: string): string[] {
  const lines = branches.flatMap((branch, index) => {
    const mark = index === 0 ? "< " : "| ";
    const inner = writePath(branch, `${indent}  `);
    const first = inner[0] ?? "";
    return [`${indent}${mark}${first.slice(indent.length + 2)}`.trimEnd(), ...inner.slice(1)];
  });
  return [...lines, `${indent}>`];
}

/** A box with one pin a line. */
function writeWrapped(box: Box, indent: string): string[] {
  const pins = box.args.map((arg, index) => {
    const last = index === box.args.length - 1;
    return `${indent}${STEP}${writeArgument(arg)}${last ? `)${boxEnd(box)}` : ","}`;
  });
  return [`${indent}${boxStart(box)}(`, ...pins];
}
