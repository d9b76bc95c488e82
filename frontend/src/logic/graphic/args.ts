/** What is written on one line, and the arguments of a call, as ladders and diagrams have them. */

import { NotRead, type Reader } from "./reader";
import type { Argument, Box, Element, Parallel } from "./tree";

/** Reads the arguments after `(`, up to and with `)`. `branch` reads contacts of a pin's own, where a ladder may have them. */
export function readArguments(reader: Reader, branch: ((reader: Reader) => Parallel) | null): Argument[] {
  const args: Argument[] = [];
  if (reader.takes(")")) return args;
  for (;;) {
    args.push(readArgument(reader, branch));
    if (reader.takes(")")) return args;
    reader.expect(",", "close");
  }
}

function readArgument(reader: Reader, branch: ((reader: Reader) => Parallel) | null): Argument {
  reader.skip();
  const at = reader.at;
  const name = reader.word();
  let out = false;
  let named: string | null = null;
  if (name !== "") {
    reader.at += name.length;
    if (reader.takes(":=")) named = name;
    else if (reader.takes("=>")) {
      named = name;
      out = true;
    } else reader.at = at;
  }
  reader.skip();
  if (!out && branch !== null && reader.sees("<")) {
    const own = branch(reader);
    return { name: named, out, value: "", branch: own, span: { at, end: reader.at } };
  }
  const value = reader.upTo([",", ")"], "close");
  return { name: named, out, value, branch: null, span: { at, end: reader.at } };
}

/** Reads the name of what is called: a path such as `belt[1].jam`, up to and with `(`. */
export function readCallee(reader: Reader): string {
  reader.skip();
  const at = reader.at;
  const callee = reader.upTo(["("], "operand");
  if (!/^(?:[\p{L}_#%"]|\?\?\?)/u.test(callee)) throw new NotRead(at, "element");
  reader.expect("(", "operand");
  return callee;
}

/** An element on one line. */
export function writeElement(element: Exclude<Element, Parallel>): string {
  switch (element.kind) {
    case "contact":
      return `[${moded(element.mode, element.operand)}]`;
    case "coil":
      return `(${moded(element.mode, element.operand)})`;
    case "send":
      return `-> #${element.name}`;
    case "receive":
      return `#${element.name}`;
    case "jump":
      return element.label === null ? "RETURN" : `JMP ${element.label}`;
    case "box":
      return `${boxStart(element)}(${element.args.map(writeArgument).join(", ")})${boxEnd(element)}`;
  }
}

const moded = (mode: string, operand: string) => (mode === "" || mode === "/" ? mode + operand : `${mode} ${operand}`);
export const boxStart = ({ result, callee }: Box) => (result === null ? callee : `${result} := ${callee}`);
export const boxEnd = ({ output }: Box) => (output === null ? "" : `.${output}`);

export function writeArgument({ name, out, value, branch }: Argument): string {
  const written = branch === null ? value : inline(branch);
  return name === null ? written : `${name} ${out ? "=>" : ":="} ${written}`;
}

/** Contacts of a pin's own, on one line. */
function inline({ branches }: Parallel): string {
  const paths = branches.map((branch) =>
    branch.map((element) => (element.kind === "parallel" ? inline(element) : writeElement(element))).join(" "),
  );
  return `<${paths.join(" | ")}>`;
}
