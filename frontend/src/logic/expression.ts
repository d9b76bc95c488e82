/** A condition as it is typed, and what to do with the names that the PLC did not know. */

const NAME = /[A-Za-z_]\w*(?:\.\w+|\[[^\]]*\])*/g;
const WORDS = new Set(["AND", "OR", "XOR", "NOT", "MOD", "TRUE", "FALSE"]);

/** The expression with the unknown name, which the refusal names, replaced by a near match. */
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
