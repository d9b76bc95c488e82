/** What is different between two versions of the files of a project. */

/** A version by its number, a commit by its name, or the texts as they are edited here. */
export type Side = number | "now" | `git:${string}`;

export const sideOfCommit = (commit: string): `git:${string}` => `git:${commit}`;
export const commitOf = (side: `git:${string}`): string => side.slice("git:".length);

/** A side as a list of choices gives it back. */
export function sideOf(chosen: string): Side {
  if (chosen.startsWith("git:")) return chosen as `git:${string}`;
  return chosen === "now" ? "now" : Number(chosen);
}

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

interface Entry {
  side: Exclude<Side, "now">;
  at: string;
}

/** Versions and commits as one list, the last one first. */
export function history<V extends { version: number; at: string }, C extends { commit: string; at: string }>(
  versions: readonly V[],
  commits: readonly C[],
): (Entry & { version: V | null; commit: C | null })[] {
  const built = versions.map((version) => ({ side: version.version, at: version.at, version, commit: null }));
  const committed = commits.map((commit) => ({
    side: sideOfCommit(commit.commit),
    at: commit.at,
    version: null,
    commit,
  }));
  return [...built, ...committed].sort((a, b) => Date.parse(b.at) - Date.parse(a.at));
}
