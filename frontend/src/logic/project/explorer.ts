/** The rows of the explorer: files grouped by the kind of what they declare. */
import type { FileInfo, Pou } from "../../wire/types";
import { pouAt } from "../plc/sourceLines";
import { isPanelFile, panelName } from "./panelFiles";

export interface PouNode {
  kind: "pou";
  name: string;
  file: string;
  line: number;
  /** The file contains other declarations, too, so its name is shown. */
  shared: boolean;
}

export interface FileNode {
  kind: "file";
  name: string;
  file: string;
}

export interface PouGroup {
  kind: (typeof ORDER)[number] | "library" | "panel" | "plant" | "file";
  nodes: (PouNode | FileNode)[];
}

// Methods and properties are not listed: they are in the text of their block.
const ORDER = ["program", "function_block", "class", "interface", "function", "type", "global"] as const;

/** Files that drive the inputs: the folder `plant/`, of a project or of a folder in it. */
const inPlant = (path: string) => /(^|\/)plant\//.test(path);

/** Libraries declare dozens of blocks that nobody here wrote: the explorer shows their files. */
const inLibraries = (path: string) => /^libraries\//.test(path);

const isApart = (path: string) => inPlant(path) || inLibraries(path) || isPanelFile(path);

/**
 * Groups in the order of the standard, then libraries, operator panels and the plant by their files; files without a declaration (new, or with errors) come last,
 * by their names.
 */
export function pouGroups(declarations: readonly Pou[], files: readonly FileInfo[]): PouGroup[] {
  const pous = declarations.filter(({ file }) => !isApart(file));
  const perFile = new Map<string, number>();
  for (const pou of pous) perFile.set(pou.file, (perFile.get(pou.file) ?? 0) + 1);
  const groups: PouGroup[] = ORDER.map((kind) => {
    const declared = pous.filter((pou) => pou.kind === kind);
    return { kind, nodes: kind === "global" ? globalFiles(declared) : declared.map((pou) => pouNode(pou, perFile)) };
  });
  const libraries = files.filter(({ path }) => inLibraries(path));
  groups.push({ kind: "library", nodes: libraries.map(({ path }) => fileNode(path, libraryName(path))) });
  const panels = files.filter(({ path }) => isPanelFile(path));
  groups.push({ kind: "panel", nodes: panels.map(({ path }) => fileNode(path, panelName(path))) });
  const plant = files.filter(({ path }) => inPlant(path) && !isPanelFile(path));
  groups.push({ kind: "plant", nodes: plant.map(({ path }) => fileNode(path, path.replace(/^plant\//, ""))) });
  // A method, property or action may have a file of its own, as in a text export of CODESYS.
  const shown = new Set(pous.filter(isListed).map(({ file }) => file));
  const loose = files.filter(({ path }) => !shown.has(path) && !isApart(path));
  groups.push({ kind: "file", nodes: loose.map(({ path }) => fileNode(path, path)) });
  return groups.filter((group) => group.nodes.length > 0);
}

const isListed = ({ kind }: Pou) => (ORDER as readonly string[]).includes(kind);

const libraryName = (path: string) => path.replace(/^libraries\//, "").replace(/\.st$/, "");

const fileNode = (file: string, name: string): FileNode => ({ kind: "file", name, file });

function pouNode(pou: Pou, perFile: ReadonlyMap<string, number>): PouNode {
  return { ...pou, kind: "pou", shared: (perFile.get(pou.file) ?? 0) > 1 };
}

/** Global variables come in dozens: the explorer shows the file that declares them. */
function globalFiles(globals: readonly Pou[]): PouNode[] {
  const firsts = new Map<string, Pou>();
  for (const pou of globals) if (!firsts.has(pou.file)) firsts.set(pou.file, pou);
  return [...firsts.values()].map(({ file, line }) => ({ kind: "pou", name: file, file, line, shared: false }));
}

/** The declaration around the cursor, among those that the explorer shows: for a method it is its block. */
export function shownAt(pous: readonly Pou[], file: string, line: number): Pou | undefined {
  return pouAt(
    pous.filter((pou) => isListed(pou) && pou.kind !== "global"),
    file,
    line,
  );
}

const NAME = /^[\p{L}\d_][\p{L}\d_\- .]*$/u;
const XML_FILE = /\.tc(pou|dut|gvl|io)$/i;
const TEXT_FILE = /\.(st|iecst|exp)$/i;
const TABLE = /\.csv$/i;
/** Files whose name says what they are: what the program has to do when errors come. */
const NAMED = /^required\.reactions$/;

/** What the file picker offers: files that the compiler reads, and operator panels. */
export const FILE_ENDINGS = ".st,.iecst,.exp,.tcpou,.tcdut,.tcgvl,.tcio,.scl,.udt,.db,.csv,.panel.json,.reactions";

/** Whether a file from this computer is one of a project, by its name. */
export const isProjectFile = (name: string) =>
  FILE_ENDINGS.split(",").some((ending) => name.toLowerCase().endsWith(ending));

/** Whether it is a project as a whole: a zip, PLCopen or L5X file. */
export const isWholeProject = (name: string) => /\.(zip|xml|l5x)$/i.test(name);

/** A table of inputs, not a program. */
export const isTable = (path: string) => TABLE.test(path);

/** Not a program either: what it has to do when errors come. */
export const isRequirements = (path: string) => NAMED.test(path);

/** The path for a file of this name: tables drive the inputs, so they go to the plant. */
export const placeFor = (name: string) => (isTable(name) && !inPlant(name) ? `plant/${name}` : name);

/** The path for a new file by the typed name, which may contain a folder; null when it is not valid. */
export function newFilePath(typed: string, existing: readonly FileInfo[]): string | null {
  const name = typed.trim();
  if (!name.split("/").every((part) => NAME.test(part))) return null;
  const known = TEXT_FILE.test(name) || XML_FILE.test(name) || isTable(name) || NAMED.test(name);
  const path = placeFor(known ? name : `${name}.st`);
  return existing.some((file) => file.path.toLowerCase() === path.toLowerCase()) ? null : path;
}

/** Whether a declaration of a chosen kind begins the file: a table, requirements and XML are none. */
export const declares = (path: string) => !isTable(path) && !isRequirements(path) && !XML_FILE.test(path);
