/** The files of a project that are operator panels, and the names that people see of them. */

const ENDING = ".panel.json";

export const isPanelFile = (path: string) => path.toLowerCase().endsWith(ENDING);

/** `line/Belt.panel.json` to `Belt`. */
export const panelName = (path: string) => path.slice(path.lastIndexOf("/") + 1, -ENDING.length);

/** The path of a new panel by the typed name; null when it is not valid, or taken. */
export function panelPath(typed: string, existing: readonly { path: string }[]): string | null {
  const name = typed.trim();
  if (!/^[\p{L}\d_][\p{L}\d_\- ]*$/u.test(name)) return null;
  const path = `${name}${ENDING}`;
  return existing.some((file) => file.path.toLowerCase() === path.toLowerCase()) ? null : path;
}
