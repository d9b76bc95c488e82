/** A condition as it is typed, and how to replace the names that the PLC did not know. */

const NAME = /[A-Za-z_]\w*(?:\.\w+|\[[^\]]*\])*/g;
const WORDS = new Set(["AND", "OR", "XOR", "NOT", "MOD", "TRUE", "FALSE"]);

/** The expression with the unknown name (the refusal contains it) replaced by a near match. */
export function withName(expression: string, refusal: string, name: string): string {
  const names = [...expression.matchAll(NAME)]
    .map(([found]) => found)
    .filter((found) => !WORDS.has(found.toUpperCase()));
  const said = names.filter((found) => new RegExp(`(?<![\\w.])${escaped(found)}(?![\\w.[])`, "i").test(refusal));
  const unknown = said[0] ?? (names.length === 1 ? names[0] : undefined);
  return unknown === undefined ? name : expression.replace(unknown, name);
}

function escaped(text: string): string {
  return text.replace(/[.*+?^${}()|[\]\\]/g, "\\$&");
}

/** The path that is being typed directly before the caret, to be completed. Empty when there is none. */
export function pathBefore(text: string, caret: number): string {
  const found = /(?:%|[A-Za-z_])[\w.%[\]:]*$/.exec(text.slice(0, caret))?.[0] ?? "";
  return WORDS.has(found.toUpperCase()) ? "" : found;
}

/** The condition with the path before the caret completed, and the new position of the caret. */
export function withPath(text: string, caret: number, path: string): { text: string; caret: number } {
  const from = caret - pathBefore(text, caret).length;
  return { text: text.slice(0, from) + path + text.slice(caret), caret: from + path.length };
}
