/** Reads the text of a NETWORK into the items that are drawn. */

import { type DiagramInput, type DiagramItem, type DiagramOutput, type DiagramPin, wireOf } from "./diagram";
import type { Found } from "./networks";
import { commentEnd, NotRead, Reader, stringEnd } from "./reader";
import type { Unread } from "./tree";

interface Diagram {
  kind: "network";
  items: readonly DiagramItem[];
}

const LEAVE = /^(?:RETURN|JMP\s+([\p{L}_][\p{L}\p{N}_]*))(?:\s+IF\s+([\s\S]+))?$/iu;
const WIRE = /^(#\s*[\p{L}_][\p{L}\p{N}_]*)\s*(?::([^=]+))?=(?!=)\s*([\s\S]+)$/u;
const ASSIGNED = /^([\p{L}_%][^(]*?)\s*(?::=|\s([SR])\s*=)\s*([\s\S]+)$/iu;
const CALL = /^((?!NOT\b)[\p{L}_][\p{L}\p{N}_]*(?:\.[\p{L}_][\p{L}\p{N}_]*|\[[^\]]*\])*)\s*\(/iu;
const EDGE = /^(NOT\s+)?([RF])_EDGE\s+([\p{L}_#%][\s\S]*)$/iu;
const NEGATED = /^NOT\s+([\p{L}_%#][\p{L}\p{N}_.]*(?:\[[^\]]*\][\p{L}\p{N}_.]*)*)$/iu;
const NAMED = /^(?:(NOT)\s+)?([\p{L}_][\p{L}\p{N}_]*)\s*(:=|=>)\s*([\s\S]+)$/iu;

/** The diagram, or why its text cannot be read. */
export function readDiagram(found: Found): Diagram | Unread {
  const text = withoutComments(found.text);
  const reader = new Reader(text, found.body.at, found.body.end);
  const items: DiagramItem[] = [];
  try {
    while (!reader.done()) {
      const at = reader.at;
      const written = reader.upTo([";"], "end");
      const end = at + text.slice(at, reader.at).trimEnd().length;
      reader.expect(";", "end");
      if (written !== "") items.push({ ...readItem(written, at), span: { at, end } });
    }
    if (!found.closed) throw new NotRead(text.length, "end");
    return { kind: "network", items };
  } catch (error) {
    if (error instanceof NotRead) return { kind: "unread", at: error.at, expected: error.expected };
    throw error;
  }
}

/** The text with blanks in place of its comments. */
function withoutComments(text: string): string {
  let made = "";
  for (let at = 0; at < text.length; ) {
    const comment = commentEnd(text, at);
    const here = text[at] ?? "";
    const next = comment > at ? comment : here === "'" || here === '"' ? stringEnd(text, at) : at + 1;
    made += comment > at ? text.slice(at, next).replace(/[^\n]/g, " ") : text.slice(at, next);
    at = next;
  }
  return made;
}

function readItem(text: string, at: number): Omit<DiagramItem, "span"> {
  const leave = LEAVE.exec(text);
  if (leave) {
    const inputs = leave[2] ? [{ ...readPin(leave[2]), name: "" }] : [];
    return { kind: "leave", callee: "", inputs, outputs: [], label: leave[1] ?? "" };
  }
  const wire = WIRE.exec(text);
  const assigned = wire ? null : ASSIGNED.exec(text);
  const target = (wire?.[1] ?? assigned?.[1] ?? "").replace(/^#\s+/, "#");
  const operator = (assigned?.[2] ?? "").toUpperCase() as DiagramOutput["operator"];
  const value = wire?.[3] ?? assigned?.[3] ?? text;
  const outputs: DiagramOutput[] =
    target === "" ? [] : [{ name: "", negated: false, target, wire: wireOf(target), operator }];
  const called = CALL.exec(value);
  const args = called && argumentsOf(value.slice(called[0].length));
  if (called && args) {
    const read = args.map((each) => readArgument(each, at));
    return {
      ...{ kind: "box", callee: called[1] ?? "", label: "" },
      inputs: read.flatMap(({ input }) => (input ? [input] : [])),
      outputs: [...outputs, ...read.flatMap(({ output }) => (output ? [output] : []))],
    };
  }
  // A value alone goes nowhere.
  if (target === "") throw new NotRead(at, "item");
  return { kind: "value", callee: "", inputs: [{ ...readPin(value), name: "" }], outputs, label: "" };
}

/** The arguments up to the bracket that closes the text; null where that is not its end. */
function argumentsOf(text: string): string[] | null {
  const reader = new Reader(text);
  const found: string[] = [];
  if (reader.takes(")")) return reader.done() ? found : null;
  do found.push(reader.upTo([",", ")"], "close"));
  while (reader.takes(","));
  return reader.takes(")") && reader.done() ? found : null;
}

function readArgument(text: string, at: number): { input?: DiagramInput; output?: DiagramOutput } {
  if (text === "") throw new NotRead(at, "operand");
  const named = NAMED.exec(text);
  if (named?.[3] === "=>") {
    const target = (named[4] ?? "").trim();
    const output = { name: named[2] ?? "", negated: named[1] !== undefined, target, wire: wireOf(target) };
    return { output: { ...output, operator: "" } };
  }
  if (named && named[1] === undefined) return { input: { ...readPin(named[4] ?? ""), name: named[2] ?? "" } };
  return { input: { ...readPin(text), name: "" } };
}

function readPin(written: string): DiagramPin {
  const text = written.trim().replace(/\s+/g, " ");
  const edge = EDGE.exec(text);
  const kind = edge?.[2]?.toUpperCase();
  if (edge) return made((edge[3] ?? "").trim(), { negated: edge[1] !== undefined, edge: kind === "R" ? "P" : "N" });
  const negated = NEGATED.exec(text);
  return negated ? made(negated[1] ?? "", { negated: true, edge: "" }) : made(text, { negated: false, edge: "" });
}

const made = (text: string, how: Pick<DiagramPin, "negated" | "edge">): DiagramPin => ({
  text,
  ...how,
  wire: wireOf(text),
});
