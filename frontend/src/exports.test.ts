import { readdirSync, readFileSync, statSync } from "node:fs";
import { dirname, join, relative } from "node:path";
import { fileURLToPath } from "node:url";
import { expect, it } from "vitest";

const root = dirname(fileURLToPath(import.meta.url));

/** Generated: offers more than is used today. */
const LEFT_OUT = ["wire/messages.gen.ts", "wire/types.ts"];

const DECLARED = /^export (?:declare )?(?:async )?(?:function\*?|const|let|class|interface|type|enum) (\w+)/gm;
const LISTED = /^export (?:type )?\{([^}]*)\}(?! from)/gm;
const FROM = /^(?:import|export) (?:type )?(?:\w+, )?\{([^}]*)\} from "(\.[^"]+)"/gm;
const LATER = /import\("(\.[^"]+)"\)/g;

const texts = new Map(
  readdirSync(root, { recursive: true, encoding: "utf8" })
    .filter((path) => /\.tsx?$/.test(path) && !path.endsWith(".d.ts"))
    .map((path) => [path, readFileSync(join(root, path), "utf8")]),
);

const names = (list: string) =>
  list
    .split(",")
    .map((part) => part.trim().replace(/^type /, ""))
    .filter(Boolean);

/** The file of the page that an import names. */
function target(path: string, name: string): string {
  const at = join(root, dirname(path), name);
  const found = [`${at}.ts`, `${at}.tsx`, join(at, "index.ts")].find((file) =>
    statSync(file, { throwIfNoEntry: false }),
  );
  return relative(root, found ?? at);
}

it("every export of a file is imported by a different file", () => {
  const used = new Set<string>();
  for (const [path, text] of texts) {
    for (const [, list = "", name = ""] of text.matchAll(FROM))
      for (const each of names(list)) used.add(`${target(path, name)} ${each.split(" as ")[0]}`);
    // A module that is imported dynamically may use any of its exports.
    for (const [, name = ""] of text.matchAll(LATER)) used.add(`${target(path, name)} *`);
  }
  const unused = [...texts].flatMap(([path, text]) => {
    if (path.includes(".test.") || LEFT_OUT.includes(path) || used.has(`${path} *`)) return [];
    const declared = [...text.matchAll(DECLARED)].map(([, name = ""]) => name);
    const listed = [...text.matchAll(LISTED)].flatMap(([, list = ""]) =>
      names(list).map((each) => each.split(" as ").at(-1)),
    );
    return [...declared, ...listed].filter((name) => !used.has(`${path} ${name}`)).map((name) => `${path} ${name}`);
  });
  expect(unused).toEqual([]);
});
