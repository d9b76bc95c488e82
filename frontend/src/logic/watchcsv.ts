/** Watch lists as CSV: `path;format;group`, one entry a line. Other separators and quotes are read, too. */
import type { WatchEntry } from "../wire/types";
import { t } from "./text";
import { FORMATS, type Format } from "./values";

const HEAD = ["path", "format", "group"];

export interface ReadList {
  entries: WatchEntry[];
  /** What could not be read, with its line. */
  bad: string[];
}

export function toCsv(entries: readonly WatchEntry[]): string {
  const lines = entries.map(({ path, format, group }) => [path, format, group].map(quoted).join(";"));
  return `${[HEAD.join(";"), ...lines].join("\r\n")}\r\n`;
}

const quoted = (text: string) => (/[";\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);

export function fromCsv(text: string): ReadList {
  const lines = text.replace(/^\uFEFF/, "").split(/\r\n|\n|\r/);
  const head = lines[0] ?? "";
  const separator = [";", "\t", ","].find((each) => head.includes(each)) ?? ";";
  const names = cells(head, separator).map((name) => name.trim().toLowerCase());
  const titled = names.includes("path");
  const column = (name: string) => (titled ? names.indexOf(name) : HEAD.indexOf(name));
  const [path, format, group] = HEAD.map(column) as [number, number, number];
  const read: ReadList = { entries: [], bad: [] };
  lines.forEach((line, index) => {
    if ((titled && index === 0) || line.trim() === "") return;
    const found = cells(line, separator);
    const entry = {
      path: (found[path] ?? "").trim(),
      format: (found[format] ?? "").trim().toLowerCase() || "default",
      group: (found[group] ?? "").trim(),
    };
    const wrong = wrongWith(entry);
    if (wrong === null) read.entries.push(entry as WatchEntry);
    else read.bad.push(t("watch.csv.line", { line: index + 1, why: wrong }));
  });
  return read;
}

function wrongWith({ path, format, group }: Record<keyof WatchEntry, string>): string | null {
  if (path === "") return t("watch.csv.nopath");
  if (path.length > 500) return t("watch.csv.longpath");
  if (!FORMATS.includes(format as Format)) return t("watch.csv.format", { format, known: FORMATS.join(", ") });
  return group.length > 100 ? t("watch.csv.group") : null;
}

/** The cells of a line; a cell in quotes may hold the separator, and two quotes for one. */
function cells(line: string, separator: string): string[] {
  const found: string[] = [];
  let cell = "";
  let inside = false;
  for (let at = 0; at < line.length; at += 1) {
    const c = line[at] as string;
    if (c === '"' && inside && line[at + 1] === '"') {
      cell += c;
      at += 1;
    } else if (c === '"' && (inside || cell === "")) inside = !inside;
    else if (c === separator && !inside) {
      found.push(cell);
      cell = "";
    } else cell += c;
  }
  return [...found, cell];
}
