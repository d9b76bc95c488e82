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
  // A server and a page for tests: nothing that runs knows it.
  testing: ["text", "logic", "store", "wire", "app/dispatch"],
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

/** The files that a file needs before it runs: neither types nor dynamic imports. */
function needs(path: string): string[] {
  const text = readFileSync(path, "utf8");
  return namesIn(text, /^(?:import|export)\s+(?!type\b)(?:[^"';]*?\sfrom\s+)?"([^"]+)"/gm).flatMap((name) =>
    name.startsWith(".") ? filesOf(path, name) : [name],
  );
}

/** The files of the page that a file names, for values and for types. */
function named(path: string): string[] {
  const text = readFileSync(path, "utf8");
  return namesIn(text, /^(?:import|export)\s+(?:[^"';]*?\sfrom\s+)?"(\.[^"]+)"/gm)
    .flatMap((name) => filesOf(path, name))
    .map((file) => relative(root, file));
}

const namesIn = (text: string, pattern: RegExp) => [...text.matchAll(pattern)].map(([, name = ""]) => name);

const filesOf = (path: string, name: string) =>
  ["", ".ts", ".tsx", "/index.ts"]
    .map((end) => join(dirname(path), name + end))
    .filter((file) => /\.tsx?$/.test(file) && existsSync(file));

/** The feature that a file of `logic`, `store` or `panels` belongs to; empty elsewhere. */
const featureOf = (path: string) => (path.split("/").length > 2 ? (path.split("/")[1] ?? "") : "");

/** A panel counts as a folder of its own, with the folders inside of it, and so does a group with one panel. */
function folderOf(path: string): string {
  const parts = path.split("/").slice(0, -1);
  return parts[0] === "panels" ? parts.slice(0, 3).join("/") : (parts[0] ?? "");
}

/** The panels of a feature may import what they share, which is beside them. */
const groupOf = (path: string) => (path.split("/").length > 3 ? path.split("/").slice(0, 2).join("/") : folderOf(path));

/** What a feature of `logic` and `store` may import besides itself; no feature knows any other. */
const COMMON = ["format", "page", "plc", "project"];
const FEATURES: Record<string, readonly string[]> = {
  format: [],
  page: ["format"],
  plc: ["format", "page"],
  project: ["format", "page", "plc"],
  errors: COMMON,
  graphic: COMMON,
  trace: COMMON,
  verify: COMMON,
  watch: COMMON,
  operator: COMMON,
  past: [...COMMON, "verify"], // the timeline marks the differences that verifications found
  debug: [...COMMON, "verify"], // a step may belong to a verification, which waits for it
};

/** The shortest import circle through a file; empty when there is none. */
function circle(start: string, graph: ReadonlyMap<string, readonly string[]>): string[] {
  const from = new Map<string, string>();
  const queue = [start];
  for (const path of queue)
    for (const next of graph.get(path) ?? []) {
      if (next === start) {
        const way = [start];
        for (let at = path; at !== start; at = from.get(at) ?? start) way.unshift(at);
        return [start, ...way];
      }
      if (!from.has(next)) {
        from.set(next, path);
        queue.push(next);
      }
    }
  return [];
}

describe("layers", () => {
  for (const layer of Object.keys(ALLOWED)) {
    it(`${layer} imports downward only`, () => {
      const wrong: string[] = [];
      for (const path of sources(join(root, layer))) {
        const from = relative(root, path);
        for (const target of imports(path)) {
          const fine =
            [folderOf(from), groupOf(from)].includes(folderOf(`${target}.ts`)) ||
            (ALLOWED[layer] ?? []).some((allowed) => target === allowed || target.startsWith(`${allowed}/`));
          if (!fine) wrong.push(`${from} imports ${target}`);
        }
      }
      expect(wrong).toEqual([]);
    });
  }

  for (const layer of ["logic", "store"]) {
    it(`a feature of ${layer} imports no other feature`, () => {
      const wrong: string[] = [];
      for (const path of sources(join(root, layer))) {
        const from = relative(root, path);
        for (const target of imports(path)) {
          const [feature, other] = [featureOf(from), featureOf(`${target}.ts`)];
          if (other !== "" && other !== feature && !FEATURES[feature]?.includes(other))
            wrong.push(`${from} imports ${target}`);
        }
      }
      expect(wrong).toEqual([]);
    });
  }

  it("no file imports itself, directly or through others", () => {
    const graph = new Map(sources(root).map((path) => [relative(root, path), named(path)]));
    expect([...graph.keys()].map((path) => circle(path, graph)).filter((way) => way.length > 0)).toEqual([]);
    const round = { a: ["b"], b: ["c"], c: ["a"] };
    expect(circle("a", new Map(Object.entries(round)))).toEqual(["a", "b", "c", "a"]);
  });

  it("the page starts without Monaco", () => {
    const seen = new Set([join(root, "main.tsx")]);
    for (const path of seen) if (path.startsWith(root)) for (const next of needs(path)) seen.add(next);
    expect([...seen].filter((path) => path.startsWith("monaco-editor"))).toEqual([]);
    expect([...seen].filter((path) => relative(root, path).startsWith("testing/"))).toEqual([]);
    expect([...seen]).toContain(join(root, "panels/project/editor/EditorPanel.tsx"));
    expect(needs(join(root, "panels/project/editor/monaco.ts"))).toContain("monaco-editor/editor");
  });

  it("finds the imports that the other tests judge", () => {
    expect(imports(join(root, "main.tsx"))).toContain("app/App");
  });
});
