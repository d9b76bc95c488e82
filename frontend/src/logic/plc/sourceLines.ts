/** Lines of source text: which declaration they belong to, and where they are in a different version of the text. */
import type { Pou } from "../../wire/types";

/**
 * The declaration that contains a line of a file, for `Add to watch` in the editor. If the text is given, a method or
 * action ends at its end: the body of a block may come after its methods.
 */
export function pouAt(pous: readonly Pou[], file: string, line: number, text = ""): Pou | undefined {
  const ended = (pou: Pou) =>
    (pou.kind === "method" || pou.kind === "property" || pou.kind === "action") &&
    linesOf(text)
      .slice(pou.line - 1, line - 1)
      .some((each) => /\bEND_(METHOD|PROPERTY|ACTION)\b/i.test(each));
  return pous
    .filter((pou) => pou.file === file && pou.line <= line && !ended(pou))
    .sort((a, b) => b.line - a.line)
    .at(0);
}

/** The declaration whose variables the text of one names: an action has those of its POU. */
export function ownerOf(pous: readonly Pou[], pou: Pou): Pou {
  if (pou.kind !== "action") return pou;
  const name = pou.name.slice(0, pou.name.lastIndexOf(".")).toUpperCase();
  return pous.find((each) => each.file === pou.file && each.name.toUpperCase() === name) ?? pou;
}

/**
 * The line in a different version of a text: lines before and after the edited part keep their places, lines inside it go to its
 * end.
 */
export function lineIn(from: string, to: string, line: number): number {
  if (from === to) return line;
  const { head, tail, before, after } = sameEnds(from, to);
  if (line <= head) return line;
  if (line > before - tail) return line - before + after;
  return Math.max(1, Math.min(line, after - tail));
}

/** Lines that two texts begin and end with in common, and how many each has. */
interface Ends {
  head: number;
  tail: number;
  before: number;
  after: number;
}

/** What was found out last, about texts that are shown and that were built: a drawing asks for each of its elements. */
const MOST = 8;
const split = new Map<string, readonly string[]>();
let compared: { from: string; to: string; ends: Ends }[] = [];

function linesOf(text: string): readonly string[] {
  const known = split.get(text);
  if (known) return known;
  if (split.size >= MOST) split.clear();
  const lines = text.split("\n");
  split.set(text, lines);
  return lines;
}

function sameEnds(from: string, to: string): Ends {
  const known = compared.find((each) => each.from === from && each.to === to);
  if (known) return known.ends;
  const [a, b] = [linesOf(from), linesOf(to)];
  let head = 0;
  while (head < a.length && head < b.length && a[head] === b[head]) head += 1;
  let tail = 0;
  while (tail < a.length - head && tail < b.length - head && a.at(-1 - tail) === b.at(-1 - tail)) tail += 1;
  const ends = { head, tail, before: a.length, after: b.length };
  compared = [{ from, to, ends }, ...compared.slice(0, MOST - 1)];
  return ends;
}

/** Whether these lines of the shown text, from `line` on, are lines of the built one, and not only equal to some others of it. */
export function isBuilt(shown: string, built: string, line: number, text: string): boolean {
  if (shown === built) return true;
  const from = lineIn(shown, built, line);
  if (lineIn(built, shown, from) !== line) return false;
  const lines = text.split("\n");
  const found = linesOf(built).slice(from - 1, from - 1 + lines.length);
  return found.join("\n").includes(text);
}

/** Places in the built text, as they are in the shown one; those whose first line was edited since are left out. */
export function movedTo<Place extends { line: number; end_line: number }>(
  shown: string,
  built: string,
  places: readonly Place[],
): Place[] {
  const [now, then] = [shown.split("\n"), built.split("\n")];
  return places
    .map((place) => ({ place, line: lineIn(built, shown, place.line), end_line: lineIn(built, shown, place.end_line) }))
    .filter(({ place, line }) => now[line - 1] === then[place.line - 1])
    .map(({ place, line, end_line }) => ({ ...place, line, end_line }));
}
