/** What is different between two versions of the files of a project. */

export interface Difference {
  path: string;
  /** Null: that version has no such file. */
  before: string | null;
  after: string | null;
}

type Texts = Readonly<Record<string, string>>;

/** The files that are not the same, by path. */
export function differences(before: Texts, after: Texts): Difference[] {
  const paths = [...new Set([...Object.keys(before), ...Object.keys(after)])].sort((a, b) => a.localeCompare(b));
  return paths
    .filter((path) => before[path] !== after[path])
    .map((path) => ({ path, before: before[path] ?? null, after: after[path] ?? null }));
}
