/** Where the rungs and networks of a file are. A network is found by its first line, so that one that cannot be read hides no other. */

import { commentEnd, stringEnd, wordsIn } from "./reader";
import type { Head } from "./tree";

/** A network in the text of a file; offsets are those of the file, lines count from 1. */
export interface Found {
  kind: "rung" | "network" | "chart";
  head: Head;
  /** From the word RUNG or NETWORK up to the end of END_RUNG or END_NETWORK; of a chart from its first part to the end of its POU. */
  from: number;
  to: number;
  line: number;
  /** The blanks before its first word. */
  indent: string;
  /** The part of the text between head and end, as offsets from `from`. */
  body: { at: number; end: number };
  /** The whole text of the network. */
  text: string;
  /** Whether its end was found, and that of its title. */
  closed: boolean;
}

const BEGIN = /^([ \t]*)(?:(\{off\})[ \t]*\n?[ \t]*)?(RUNG|NETWORK)\b([^\n]*)/i;
const HEAD = /^[ \t]*(?:([\p{L}_][\p{L}\p{N}_]*)[ \t]*:)?[ \t]*(?:"((?:[^"$\n]|\$.)*)")?[ \t]*(?:\/\/[^\n]*)?\r?$/u;

/** While its title is typed it has no end yet. */
const OPEN_TITLE = /^[ \t]*(?:([\p{L}_][\p{L}\p{N}_]*)[ \t]*:)?[ \t]*"((?:[^"$\n]|\$.)*)\$?\r?$/u;

/** All networks of a file, in the order of the text. */
export const networksIn = (text: string): Found[] => scan(text, { at: 0, line: 1 }, () => null);

/** What was found in a text before it was edited. */
interface Earlier {
  text: string;
  networks: readonly Found[];
}

/** The same, where most of the text is as it was: what is before and after the edited part is not looked for again. */
export function networksAfter(text: string, earlier: Earlier): Found[] {
  const { text: before, networks } = earlier;
  const moved = text.length - before.length;
  const least = Math.min(text.length, before.length);
  let head = 0;
  while (head < least && text[head] === before[head]) head += 1;
  let tail = 0;
  while (tail < least - head && text[text.length - 1 - tail] === before[before.length - 1 - tail]) tail += 1;
  // One that ends before the edited part ends where it did, as the character after it is the same.
  const first = networks.findIndex(({ to, closed }) => !closed || to >= head);
  const kept = first < 0 ? networks : networks.slice(0, first);
  const last = kept.at(-1);
  const begin = last
    ? { at: last.to, line: last.line + count(text, last.from, last.to), inside: true }
    : { at: 0, line: 1 };
  const byStart = new Map(networks.map((found, index) => [found.from, index]));
  const rest = (found: Found): Found[] | null => {
    const index = found.from >= text.length - tail ? byStart.get(found.from - moved) : undefined;
    const old = index === undefined ? undefined : networks[index];
    if (old === undefined || old.text !== found.text || old.head.off !== found.head.off) return null;
    const lines = found.line - old.line;
    return networks
      .slice((index ?? 0) + 1)
      .map((each) => ({ ...each, from: each.from + moved, to: each.to + moved, line: each.line + lines }));
  };
  return [...kept, ...scan(text, begin, rest)];
}

/** From a place outside of comments and networks. `rest`: what follows a network, where that is known. */
function scan(
  text: string,
  begin: { at: number; line: number; inside?: boolean },
  rest: (found: Found) => readonly Found[] | null,
): Found[] {
  const found: Found[] = [];
  let { at, line } = begin;
  let lineStart = begin.inside !== true;
  while (at < text.length) {
    if (lineStart) {
      const network = networkAt(text, at, line);
      if (network) {
        const known = rest(network);
        if (known) return [...found, network, ...known];
        found.push(network);
        line += count(text, at, network.to);
        at = network.to;
        lineStart = !network.closed;
        continue;
      }
    }
    const here = text[at] ?? "";
    const comment = commentEnd(text, at);
    const next = comment !== at ? comment : here === "'" || here === '"' ? stringEnd(text, at) : at + 1;
    line += count(text, at, next);
    lineStart = here === "\n" || (lineStart && comment !== at && text[at + 1] !== "/");
    at = next;
  }
  return found;
}

/** The networks of each body: between two of one body there are no words but that of `{off}`. */
export function bodiesOf(text: string): Found[][] {
  const bodies: Found[][] = [];
  let end = 0;
  for (const found of networksIn(text)) {
    const beside = [...wordsIn(text, end, found.from)].every(({ word }) => word === "OFF");
    const last = bodies.at(-1);
    if (last && beside) last.push(found);
    else bodies.push([found]);
    end = found.to;
  }
  return bodies;
}

/** The network that begins in the line at this offset; null when none does. */
function networkAt(text: string, at: number, line: number): Found | null {
  const begin = BEGIN.exec(text.slice(at, at + 2000));
  if (!begin) return null;
  const [whole, indent = "", off, word = "", rest = ""] = begin;
  const said = HEAD.exec(rest);
  const head = said ?? OPEN_TITLE.exec(rest);
  if (!head) return null;
  const kind = word.toUpperCase() === "RUNG" ? "rung" : "network";
  const from = at + whole.length - rest.length - word.length;
  const headEnd = at + whole.length;
  const { comment, at: bodyAt } = commentBelow(text, headEnd);
  const { at: bodyEnd, to } = endOf(text, bodyAt, kind);
  return {
    kind,
    head: { label: head[1] ?? "", title: unescaped(head[2] ?? ""), comment, off: off !== undefined },
    from,
    to,
    line: line + count(text, at, from),
    indent,
    body: { at: bodyAt - from, end: bodyEnd - from },
    text: text.slice(from, to),
    closed: to > bodyEnd && said !== null,
  };
}

/** The lines of comment below the head, and the offset after them. */
function commentBelow(text: string, at: number): { comment: string[]; at: number } {
  const comment: string[] = [];
  const lines = /\n[ \t]*\/\/([^\n]*)/y;
  let end = at;
  for (;;) {
    lines.lastIndex = end;
    const found = lines.exec(text);
    if (!found) return { comment, at: end };
    comment.push((found[1] ?? "").trim());
    end = lines.lastIndex;
  }
}

/** Where the word that ends the network begins and ends; where the next network or the POU begins if it is missing. */
function endOf(text: string, from: number, kind: "rung" | "network"): { at: number; to: number } {
  const wanted = kind === "rung" ? "END_RUNG" : "END_NETWORK";
  for (const { word, at } of wordsIn(text, from)) {
    if (word === wanted) return { at, to: at + word.length };
    if (word.startsWith("END_")) return { at, to: at };
    if ((word === "RUNG" || word === "NETWORK") && startsLine(text, at))
      return { at: lineStartOf(text, at), to: lineStartOf(text, at) };
  }
  return { at: text.length, to: text.length };
}

export const lineStartOf = (text: string, at: number) => text.lastIndexOf("\n", at - 1) + 1;
export const startsLine = (text: string, at: number) => text.slice(lineStartOf(text, at), at).trim() === "";
const unescaped = (title: string) => title.replace(/\$(.)/g, "$1");

export function count(text: string, from: number, to: number): number {
  let lines = 0;
  for (let at = text.indexOf("\n", from); at >= 0 && at < to; at = text.indexOf("\n", at + 1)) lines += 1;
  return lines;
}
