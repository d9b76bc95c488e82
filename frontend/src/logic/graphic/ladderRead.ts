/** Reads the text of a rung into the elements that are drawn. */

import { readArguments, readCallee } from "./args";
import { NOTHING } from "./diagram";
import type { Found } from "./networks";
import { NotRead, Reader } from "./reader";
import type { Box, Coil, CoilMode, Contact, ContactMode, Element, Jump, Parallel, Path, Rung, Unread } from "./tree";

/** A word that goes on as an expression: then a letter before it is a variable, not a mode. */
const OPERATOR = /^(?:(?:AND|OR|XOR|MOD)(?![\p{L}\p{N}_])|=|<|>|\+|-|\*|\/|&|\.|\[)/iu;
const STARTS = /^[\p{L}_%"#(]/u;

/** The rung, or why its text cannot be read. `comments` says that there are comments between its elements. */
export function readRung(found: Found): (Rung & { comments: boolean }) | Unread {
  const reader = new Reader(found.text, found.body.at, found.body.end);
  try {
    const path = readPath(reader);
    if (!reader.done()) throw new NotRead(reader.at, "element");
    if (!found.closed) throw new NotRead(found.text.length, "end");
    return { kind: "rung", head: found.head, path, comments: reader.comments };
  } catch (error) {
    if (error instanceof NotRead) return { kind: "unread", at: error.at, expected: error.expected };
    throw error;
  }
}

function readPath(reader: Reader): Path {
  const path: Element[] = [];
  while (!reader.done() && !reader.sees("|") && !reader.sees(">")) path.push(readElement(reader));
  return path;
}

function readElement(reader: Reader): Element {
  if (reader.sees("[")) return readContact(reader);
  if (reader.sees("(")) return readCoil(reader);
  if (reader.sees("<")) return readParallel(reader);
  const at = reader.at;
  if (reader.takes("->")) {
    reader.expect("#", "element");
    return { kind: "send", name: takeWord(reader), span: { at, end: reader.at } };
  }
  if (reader.takes("#")) return { kind: "receive", name: takeWord(reader), span: { at, end: reader.at } };
  const word = reader.word();
  // A box without a name, or without a variable for its result, is drawn, too: the program is not built until it has one.
  if (word === "" && !reader.sees(NOTHING)) throw new NotRead(at, "element");
  if (/^(?:JMP|RETURN)$/i.test(word)) return readJump(reader, word);
  return readBox(reader);
}

function takeWord(reader: Reader): string {
  const word = reader.word();
  if (word === "") throw new NotRead(reader.at, "operand");
  reader.at += word.length;
  return word;
}

function readContact(reader: Reader): Contact {
  const at = reader.at;
  reader.expect("[", "element");
  const inside = reader.upTo(["]"], "close");
  reader.expect("]", "close");
  const { mode, operand } = moded(inside, /^[/]/, /^[PN](?=\s)/i);
  return { kind: "contact", mode: mode as ContactMode, operand, span: { at, end: reader.at } };
}

function readCoil(reader: Reader): Coil {
  const at = reader.at;
  reader.expect("(", "element");
  const inside = reader.upTo([")"], "close");
  reader.expect(")", "close");
  const { mode, operand } = moded(inside, /^[/]/, /^[SRPN](?=\s)/i);
  return { kind: "coil", mode: mode as CoilMode, operand, span: { at, end: reader.at } };
}

/** Divides `/stop` and `P first` into the mode and the operand. */
function moded(inside: string, sign: RegExp, letter: RegExp): { mode: string; operand: string } {
  if (sign.test(inside)) return { mode: inside[0] ?? "", operand: inside.slice(1).trim() };
  const found = letter.exec(inside)?.[0];
  const rest = found ? inside.slice(found.length).trim() : "";
  if (found && STARTS.test(rest) && !OPERATOR.test(rest)) return { mode: found.toUpperCase(), operand: rest };
  return { mode: "", operand: inside };
}

function readParallel(reader: Reader): Parallel {
  const at = reader.at;
  reader.expect("<", "element");
  const branches: Path[] = [readPath(reader)];
  while (reader.takes("|")) branches.push(readPath(reader));
  reader.expect(">", "close");
  return { kind: "parallel", branches, span: { at, end: reader.at } };
}

function readJump(reader: Reader, word: string): Jump {
  const at = reader.at;
  reader.at += word.length;
  const label = /^JMP$/i.test(word) ? takeWord(reader) : null;
  return { kind: "jump", label, span: { at, end: reader.at } };
}

function readBox(reader: Reader): Box {
  const at = reader.at;
  let result: string | null = null;
  const first = reader.upTo([":=", "("], "operand");
  if (reader.takes(":=")) result = first;
  else reader.at = at;
  const callee = readCallee(reader);
  const args = readArguments(reader, readParallel);
  let output: string | null = null;
  if (reader.text[reader.at] === ".") {
    reader.at += 1;
    output = takeWord(reader);
  }
  return { kind: "box", result, callee, args, output, span: { at, end: reader.at } };
}
