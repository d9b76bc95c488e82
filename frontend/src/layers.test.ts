import { existsSync, readdirSync, readFileSync } from "node:fs";
import { dirname, join, relative } from "node:path";
import { fileURLToPath } from "node:url";
import { describe, expect, it } from "vitest";

const root = dirname(fileURLToPath(import.meta.url));

/** What a folder may import besides itself. A panel counts as a folder of its own. */
const ALLOWED: Record<string, readonly string[]> = {
  wire: [],
  text: [],
  logic: ["text", "wire/types"],
  store: ["text", "logic", "wire"],
  ui: ["text", "logic"],
  panels: ["text", "store", "logic", "ui", "wire/send", "wire/types"],
  app: ["text", "panels", "store", "logic", "ui", "wire"],
};

function sources(folder: string): string[] {
  return readdirSync(folder, { withFileTypes: true }).flatMap((entry) => {
    const path = join(folder, entry.name);
    if (entry.isDirectory()) return sources(path);
    return /\.tsx?$/.test(entry.name) && !entry.name.includes(".test.") ? [path] : [];
  });
}

function imports(path: string): string[] {
  const text = readFileSync(path, "utf8");
  return [...text.matchAll(/(?:from|import)\s*\(?"(\.[^"]+)"/g)].map((match) =>
    relative(root, join(dirname(path), match[1] ?? "")),
  );
}

/** What a file needs before it runs: types and what is imported later, when it is used, are not among it. */
function needs(path: string): string[] {
  const text = readFileSync(path, "utf8");
  return [...text.matchAll(/^(?:import|export)\s+(?!type\b)(?:[^"';]*?\sfrom\s+)?"([^"]+)"/gm)].flatMap(
    ([, name = ""]) => {
      if (!name.startsWith(".")) return [name];
      return ["", ".ts", ".tsx"]
        .map((end) => join(dirname(path), name + end))
        .filter((file) => /\.tsx?$/.test(file) && existsSync(file));
    },
  );
}

const folderOf = (path: string) =>
  path
    .split("/")
    .slice(0, path.startsWith("panels/") ? 2 : 1)
    .join("/");

describe("layers", () => {
  for (const layer of Object.keys(ALLOWED)) {
    it(`${layer} imports downward only`, () => {
      const wrong: string[] = [];
      for (const path of sources(join(root, layer))) {
        const from = relative(root, path);
        for (const target of imports(path)) {
          const fine =
            folderOf(target) === folderOf(from) ||
            (ALLOWED[layer] ?? []).some((allowed) => target === allowed || target.startsWith(`${allowed}/`));
          if (!fine) wrong.push(`${from} imports ${target}`);
        }
      }
      expect(wrong).toEqual([]);
    });
  }

  it("the page needs no Monaco to stand", () => {
    const seen = new Set([join(root, "main.tsx")]);
    for (const path of seen) if (path.startsWith(root)) for (const next of needs(path)) seen.add(next);
    expect([...seen].filter((path) => path.startsWith("monaco-editor"))).toEqual([]);
    expect([...seen]).toContain(join(root, "panels/editor/EditorPanel.tsx"));
    expect(needs(join(root, "panels/editor/monaco.ts"))).toContain("monaco-editor/editor");
  });

  it("finds the imports it is to judge", () => {
    expect(imports(join(root, "main.tsx"))).toContain("app/App");
  });
});
