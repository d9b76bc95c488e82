/** Lines of source text: which declaration they belong to, and where they are in a different version of the text. */
import type { Pou } from "../../wire/types";

/**
 * The declaration that contains a line of a file, for `Add to watch` in the editor. If the text is given, a method ends at its
 * end: the body of a block may come after its methods.
 */
export function pouAt(pous: readonly Pou[], file: string, line: number, text = ""): Pou | undefined {
  const lines = text.split("\n");
  const ended = (pou: Pou) =>
    (pou.kind === "method" || pou.kind === "property") &&
    lines.slice(pou.line - 1, line - 1).some((each) => /\bEND_(METHOD|PROPERTY)\b/i.test(each));
  return pous
    .filter((pou) => pou.file === file && pou.line <= line && !ended(pou))
    .sort((a, b) => b.line - a.line)
    .at(0);
}

/**
 * The line in a different version of a text: lines before and after the edited part keep their places, lines inside it go to its
 * end.
 */
export function lineIn(from: string, to: string, line: number): number {
  if (from === to) return line;
  const [a, b] = [from.split("\n"), to.split("\n")];
  let head = 0;
  while (head < a.length && head < b.length && a[head] === b[head]) head += 1;
  if (line <= head) return line;
  let tail = 0;
  while (tail < a.length - head && tail < b.length - head && a.at(-1 - tail) === b.at(-1 - tail)) tail += 1;
  if (line > a.length - tail) return line - a.length + b.length;
  return Math.max(1, Math.min(line, b.length - tail));
}

/** Whether these lines of the shown text, from `line` on, are lines of the built one, and not only equal to some others of it. */
export function isBuilt(shown: string, built: string, line: number, text: string): boolean {
  if (shown === built) return true;
  const from = lineIn(shown, built, line);
  if (lineIn(built, shown, from) !== line) return false;
  const lines = text.split("\n");
  const found = built.split("\n").slice(from - 1, from - 1 + lines.length);
  return found.join("\n").includes(text);
}
