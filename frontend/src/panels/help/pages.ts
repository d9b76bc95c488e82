/** The pages of the help: one chunk, which is loaded when somebody asks for help. */
import type { HelpEntry, HelpPage } from "../../logic/page/help";

const files = import.meta.glob<HelpPage>(
  ["../../../../docs/*.md", "../../../../docs/problems/*.md", "../../../../models/*.md", "../../../../CHANGELOG.md"],
  { eager: true, import: "default" },
);

/** By the path from `docs/`. */
export const pages: ReadonlyMap<string, HelpPage> = new Map(
  Object.entries(files).map(([path, page]) => [
    path.includes("/docs/") ? path.slice(path.indexOf("/docs/") + 6) : path.replace(/^(\.\.\/)+/, "../"),
    page,
  ]),
);

/** A page and a place on it: `watch.md#forces`. */
export function partsOf(place: string): { path: string; id: string } {
  const [path = "", id = ""] = place.split("#");
  return { path, id };
}

export function isThere(place: string): boolean {
  const { path, id } = partsOf(place);
  const page = pages.get(path);
  return page !== undefined && (id === "" || page.entries.some((entry) => entry.id === id));
}

interface Found extends HelpEntry {
  path: string;
  page: string;
}

const MOST = 60;

/** Pages about scripts, other programs, formats and what the page is made of; who works at a PLC looks for the others. */
const DEVELOPERS = ["api.md", "dap.md", "features.md", "formats.md", "lsp.md", "scripts.md"];
const isForDevelopers = (path: string) => DEVELOPERS.includes(path) || path.startsWith("../");

/** Places with all the words: those of pages for users first, and of each kind those with the words in their titles. */
export function search(text: string): Found[] {
  const words = text.toLowerCase().split(/\s+/).filter(Boolean);
  const all = [...pages].flatMap(([path, page]) =>
    page.entries.map((entry) => ({ ...entry, path, page: page.title, score: scoreOf(entry, page.title, words) })),
  );
  return all
    .filter(({ score }) => score > 0)
    .sort(
      (one, other) =>
        Number(isForDevelopers(one.path)) - Number(isForDevelopers(other.path)) || other.score - one.score,
    )
    .slice(0, MOST);
}

function scoreOf({ title, text }: HelpEntry, page: string, words: readonly string[]): number {
  const [name, above, body] = [title.toLowerCase(), page.toLowerCase(), text.toLowerCase()];
  const scores = words.map((word) =>
    name === word
      ? 9
      : name.startsWith(word)
        ? 5
        : name.includes(word)
          ? 4
          : above.includes(word)
            ? 2
            : body.includes(word)
              ? 1
              : 0,
  );
  return scores.some((score) => score === 0) ? 0 : scores.reduce((sum: number, score) => sum + score, 0);
}

/** The part of a text around the first of the words. */
export function around(text: string, words: string): string {
  const at = text.toLowerCase().indexOf(words.toLowerCase().split(/\s+/)[0] ?? "");
  const from = Math.max(0, at - 40);
  return `${from > 0 ? "… " : ""}${text.slice(from, from + 140)}${text.length > from + 140 ? " …" : ""}`;
}
