/** Instance paths as they are read: the way to the variable is faint, the last name is bright. */

export interface SplitPath {
  own: string;
  name: string;
}

/** `Main.belt[3].enable` to `Main.belt[3].` and `enable`; an address such as `A402.12` stays whole. */
export function splitPath(path: string): SplitPath {
  if (isAddress(path)) return { own: "", name: path };
  const dot = path.lastIndexOf(".");
  return { own: path.slice(0, dot + 1), name: path.slice(dot + 1) };
}

/** Raw addresses: `%MW3`, `D100`, `A402.12`, `CIO 0.00`, `W10:8`. */
export function isAddress(path: string): boolean {
  return path.startsWith("%") || /^[A-Za-z]{0,3} ?\d+(\.\d+)?(:\d+)?$/.test(path);
}

/** The paths in a dropped or typed text: one a line, or separated by commas or blanks; `CIO 0.00` is one address, and the
 * commas of `a[2,1]` separate nothing. */
export function pathsIn(text: string): string[] {
  return text
    .split(/[;\t\n\r]+|,(?![^[\]]*\])/)
    .map((part) => part.replace(/,\s+(?=[^[\]]*\])/g, ","))
    .flatMap((part) => (isAddress(part.trim()) ? [part] : part.split(/\s+/)))
    .map((part) => part.trim())
    .filter((part) => isAddress(part) || /^%?[\p{L}_\d][\p{L}\d_.[\]:%,^-]*$/u.test(part));
}

/** `src/Main.st` to `Main.st`. */
export function baseName(path: string): string {
  return path.slice(path.lastIndexOf("/") + 1);
}
