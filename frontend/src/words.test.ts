/** Comments, titles of tests and texts of the page have no words that are translated from another language word by word. */
import { readdirSync, readFileSync } from "node:fs";
import { dirname, join, relative } from "node:path";
import { fileURLToPath } from "node:url";
import { describe, expect, it } from "vitest";

const HERE = dirname(fileURLToPath(import.meta.url));
const ROOT = join(HERE, "../..");
const FOLDERS = ["frontend/src", "e2e/bench", "e2e/fixtures", "e2e/pages", "e2e/shots", "e2e/tests", "vscode/test"];

/** *After*, *before*, *is*, *again*, *corrected*, *different* are meant. The same words as in `backend/tests/docs/test_words.py`. */
const CALQUE =
  /\b(?:behind|in\s+front\s+of|stands?|standing|anew|mended|another\s+than|(?:is|are|was|were)\s+another(?=[.,:;]|\s+one))\b(?!-)/gi;
/** Where these words are right. */
const MEANT = /\blags?\s+behind\b|\bbehind\s+a\s+proxy\b|\bstands?\s+for\b/gi;
const CODE = /`[^`\n]*`/g;

const COMMENT = /\/\*[\s\S]*?\*\/|(?:^|\s)\/\/.*(?:\n\s*\/\/.*)*/g;
const TITLE = /\b(?:it|test|describe|step)(?:\.\w+)*\(\s*(["'`])(.*?)\1,/g;
const VALUE = /^\s*(?:"[^"]+"|\w+):\s*"(.*)",$/gm;

function sources(folder: string): string[] {
  return readdirSync(folder, { withFileTypes: true, recursive: true })
    .filter(({ name }) => /\.(tsx?|css|mjs)$/.test(name) && !name.endsWith(".gen.ts"))
    .map((entry) => join(entry.parentPath, entry.name));
}

const calques = (text: string) =>
  text
    .replace(/\s*\n\s*(?:\*|\/\/)?\s*/g, " ")
    .replace(CODE, "")
    .replace(MEANT, "")
    .match(CALQUE) ?? [];

/** What people read in a source file. */
function written(text: string): string[] {
  const comments = [...text.matchAll(COMMENT)].map(([comment]) => comment);
  const titles = [...text.matchAll(TITLE)].map(([, , title = ""]) => title);
  return [...comments, ...titles];
}

describe("words", () => {
  it("of comments and titles are plain English", () => {
    const found = FOLDERS.flatMap((folder) => sources(join(ROOT, folder)))
      .filter((path) => path !== fileURLToPath(import.meta.url))
      .map((path) => ({ path: relative(ROOT, path), words: written(readFileSync(path, "utf8")).flatMap(calques) }))
      .filter(({ words }) => words.length > 0);
    expect(found).toEqual([]);
  });

  it("of the page are plain English", () => {
    const texts = sources(join(HERE, "text/en")).map((path) => readFileSync(path, "utf8"));
    const values = texts.flatMap((text) => [...text.replace(/:\n\s+/g, ": ").matchAll(VALUE)]);
    expect(values.length).toBeGreaterThan(1000);
    expect(values.flatMap(([, value = ""]) => calques(value))).toEqual([]);
  });

  it("are found in comments, on two lines, and in titles, not in names", () => {
    const source =
      'const behind = 1; // it stands\n/** Far in\n * front of it, `anew`. */\ntest("mended", () => {});\nf("behind");';
    expect(written(source).flatMap(calques)).toEqual(["stands", "in front of", "mended"]);
    expect(calques("a browser lags behind; x stands for y, behind a proxy; a stand-alone file")).toEqual([]);
  });
});
