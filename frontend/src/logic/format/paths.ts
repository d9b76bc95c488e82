/** Instance paths as they are shown: the path to the variable is faint, the last name is bright. */

interface SplitPath {
  own: string;
  name: string;
}

/** `Main.belt[3].enable` to `Main.belt[3].` and `enable`; an address such as `A402.12` is not split. */
export function splitPath(path: string): SplitPath {
  if (isAddress(path)) return { own: "", name: path };
  const dot = path.replace(/\[[^\]]*\]/g, (index) => "_".repeat(index.length)).lastIndexOf(".");
  return { own: path.slice(0, dot + 1), name: path.slice(dot + 1) };
}

/** Raw addresses: `%MW3`, `D100`, `A402.12`, `CIO 0.00`, `W10:8`. */
export function isAddress(path: string): boolean {
  return path.startsWith("%") || /^[A-Za-z]{0,3} ?\d+(\.\d+)?(:\d+)?$/.test(path);
}

/** The paths in a dropped or pasted text: one a line, or separated by commas or spaces; `CIO 0.00` is one address, and the
 * comma in `a[2,1]` is not a separator. Text that is not a path is omitted. */
export function pathsIn(text: string): string[] {
  return piecesOf(text).flatMap(wordsOf).filter(isPath);
}

/** The first part of a typed text that is an expression and not a path: `a + 3`; null when all parts are paths. */
export function noPathIn(text: string): string | null {
  const odd = (word: string) => !isPath(word) || /^(AND|OR|XOR|NOT|MOD)$/i.test(word);
  return piecesOf(text).find((piece) => wordsOf(piece).some(odd)) ?? null;
}

const piecesOf = (text: string) =>
  text
    .split(/[;\t\n\r]+|,(?![^[\]]*\])/)
    .map((part) => part.replace(/,\s+(?=[^[\]]*\])/g, ",").trim())
    .filter((part) => part !== "");

const wordsOf = (piece: string) => (isAddress(piece) ? [piece] : piece.split(/\s+/));

const isPath = (word: string) => isAddress(word) || /^%?[\p{L}_\d][\p{L}\d_.[\]:%,^-]*$/u.test(word);

/** The choice made for a path itself, else for its nearest owner; case is ignored, as in the PLC. */
export function chosenFor<T>(chosen: ReadonlyMap<string, T>, path: string): T | undefined {
  const wanted = path.toUpperCase();
  let best = -1;
  let found: T | undefined;
  for (const [owner, choice] of chosen) {
    const inside = wanted.startsWith(owner.toUpperCase()) && /^$|^[.[^]/.test(wanted.slice(owner.length));
    if (!inside || owner.length <= best) continue;
    best = owner.length;
    found = choice;
  }
  return found;
}

/** `src/Main.st` to `Main.st`. */
export function baseName(path: string): string {
  return path.slice(path.lastIndexOf("/") + 1);
}
