/** Reads the text of a NETWORK into the items that are drawn. */

import { type DiagramInput, type DiagramItem, type DiagramOutput, type DiagramPin, wireOf } from "./diagram";
import type { Found } from "./networks";
import { commentEnd, NotRead, Reader, stringEnd } from "./reader";
import type { Span, Unread } from "./tree";

interface Diagram {
  kind: "network";
  items: readonly DiagramItem[];
}

const LEAVE = /^(?:RETURN|(JMP\s+)([\p{L}_][\p{L}\p{N}_]*|\?\?\?))(?:\s+IF\s+([\s\S]+))?$/iu;
const WIRE = /^(#\s*[\p{L}_][\p{L}\p{N}_]*)\s*(?::([^=]+))?=(?!=)\s*([\s\S]+)$/u;
const TYPED = /^(#\s*[\p{L}_][\p{L}\p{N}_]*)\s*:/u;
const ASSIGNED = /^((?:[\p{L}_%]|\?\?\?)[^(]*?)\s*(?::=|\s([SR])\s*=)\s*([\s\S]+)$/iu;
const CALL = /^((?!NOT\b)[\p{L}_][\p{L}\p{N}_]*(?:\.[\p{L}_][\p{L}\p{N}_]*|\[[^\]]*\])*|\?\?\?)\s*\(/iu;
const EDGE = /^(NOT\s+)?([RF])_EDGE\s+([\p{L}_#%?(][\s\S]*)$/iu;
const NEGATED = /^NOT\s+([\p{L}_%#][\p{L}\p{N}_.]*(?:\[[^\]]*\][\p{L}\p{N}_.]*)*|\?\?\?)$/iu;
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

/** `text` is without blanks at its ends and begins at this offset. */
function readItem(text: string, at: number): Omit<DiagramItem, "span"> {
  const leave = LEAVE.exec(text);
  const end = at + text.length;
  /** Of what the text ends with. */
  const last = (written: string): Span => ({ at: end - written.length, end });
  if (leave) {
    const [, word = "", label = "", condition] = leave;
    const inputs = condition ? [{ ...readPin(condition, last(condition)), name: "", arg: last(condition) }] : [];
    const named = label === "" ? null : { at: at + word.length, end: at + word.length + label.length };
    return { kind: "leave", callee: "", inputs, outputs: [], label, named, args: null };
  }
  const wire = WIRE.exec(text);
  const assigned = wire ? null : ASSIGNED.exec(text);
  const written = wire?.[1] ?? assigned?.[1] ?? "";
  const target = written.replace(/^#\s+/, "#");
  const operator = (assigned?.[2] ?? "").toUpperCase() as DiagramOutput["operator"];
  const value = wire?.[3] ?? assigned?.[3] ?? text;
  const span = { at, end: at + written.length };
  const outputs: DiagramOutput[] =
    target === "" ? [] : [{ name: "", negated: false, target, wire: wireOf(target), operator, span, arg: null }];
  const called = CALL.exec(value);
  const args = called && argumentsOf(value, called[0].length, last(value).at);
  if (called && args) {
    const read = args.map((each) => readArgument(each.text, each.at));
    const begin = last(value).at;
    const callee = called[1] ?? "";
    return {
      ...{ kind: "box", callee, label: "" },
      inputs: read.flatMap(({ input }) => (input ? [input] : [])),
      outputs: [...outputs, ...read.flatMap(({ output }) => (output ? [output] : []))],
      named: { at: begin, end: begin + callee.length },
      args: { at: begin + called[0].length, end: end - 1 },
    };
  }
  // A value alone goes nowhere.
  if (target === "") throw new NotRead(at, "item");
  const pin = { ...readPin(value, last(value)), name: "", arg: last(value) };
  return { kind: "value", callee: "", inputs: [pin], outputs, label: "", named: null, args: null };
}

/** The arguments from an offset of the text up to the bracket that closes it; null where that is not its end. `base` is the place of the text. */
function argumentsOf(text: string, from: number, base: number): { text: string; at: number }[] | null {
  const reader = new Reader(text, from);
  const found: { text: string; at: number }[] = [];
  if (reader.takes(")")) return reader.done() ? found : null;
  do {
    reader.skip();
    const { at } = reader;
    found.push({ text: reader.upTo([",", ")"], "close"), at: base + at });
  } while (reader.takes(","));
  return reader.takes(")") && reader.done() ? found : null;
}

function readArgument(text: string, at: number): { input?: DiagramInput; output?: DiagramOutput } {
  if (text === "") throw new NotRead(at, "operand");
  const named = NAMED.exec(text);
  const arg = { at, end: at + text.length };
  const value = named?.[4] ?? text;
  const span = { at: arg.end - value.length, end: arg.end };
  if (named?.[3] === "=>") {
    // A wire that keeps its value says its type.
    const target = TYPED.exec(value)?.[1] ?? value;
    const output = { name: named[2] ?? "", negated: named[1] !== undefined, target, wire: wireOf(target) };
    return { output: { ...output, operator: "", span: { at: span.at, end: span.at + target.length }, arg } };
  }
  if (named && named[1] === undefined) return { input: { ...readPin(value, span), name: named[2] ?? "", arg } };
  return { input: { ...readPin(text, arg), name: "", arg } };
}

/** A value with what negates it or looks for an edge. */
export function readPin(written: string, span: Span): DiagramPin {
  const text = written.trim().replace(/\s+/g, " ");
  const edge = EDGE.exec(text);
  const kind = edge?.[2]?.toUpperCase();
  const made = (text: string, how: Pick<DiagramPin, "negated" | "edge">) => ({
    text,
    ...how,
    wire: wireOf(text),
    span,
  });
  if (edge) return made((edge[3] ?? "").trim(), { negated: edge[1] !== undefined, edge: kind === "R" ? "P" : "N" });
  const negated = NEGATED.exec(text);
  return negated ? made(negated[1] ?? "", { negated: true, edge: "" }) : made(text, { negated: false, edge: "" });
}
