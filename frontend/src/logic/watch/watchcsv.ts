/** Watch lists as CSV: `path;format;group`, one entry a line. Other separators and quotes are read, too. */

import { t } from "../../text";
import type { WatchEntry } from "../../wire/types";
import { FORMATS, type Format } from "../format/formats";

const HEAD = ["path", "format", "group"];

interface ReadList {
  entries: WatchEntry[];
  /** A line that could not be read. */
  bad: string[];
}

export function toCsv(entries: readonly WatchEntry[]): string {
  const lines = entries.map(({ path, format, group }) => [path, format, group].map(quoted).join(";"));
  return `${[HEAD.join(";"), ...lines].join("\r\n")}\r\n`;
}

const quoted = (text: string) => {
  const safe = guarded(text);
  return /[";\r\n]/.test(safe) ? `"${safe.replaceAll('"', '""')}"` : safe;
};

/** A spreadsheet takes a cell that begins like this for a formula: a list from somebody else could contain one. */
const guarded = (text: string) => (/^'*[=+\-@\t\r]/.test(text) ? `'${text}` : text);
const unguarded = (text: string) => (/^'+[=+\-@\t\r]/.test(text) ? text.slice(1) : text);

export function fromCsv(text: string): ReadList {
  const whole = text.replace(/^\uFEFF/, "");
  const head = /^[^\r\n]*/.exec(whole)?.[0] ?? "";
  const separator = [";", "\t", ","].find((each) => head.includes(each)) ?? ";";
  const lines = records(whole, separator);
  const names = (lines[0]?.cells ?? []).map((name) => name.trim().toLowerCase());
  const titled = names.includes("path");
  const column = (name: string) => (titled ? names.indexOf(name) : HEAD.indexOf(name));
  const [path, format, group] = HEAD.map(column) as [number, number, number];
  const read: ReadList = { entries: [], bad: [] };
  for (const { line, cells, open } of titled ? lines.slice(1) : lines) {
    if (cells.every((cell) => cell.trim() === "") && cells.length === 1) continue;
    const text = (at: number) => unguarded((cells[at] ?? "").trim());
    const entry = { path: text(path), format: text(format).toLowerCase() || "default", group: text(group) };
    const wrong = open ? t("watch.csv.quote") : wrongWith(entry);
    if (wrong === null) read.entries.push(entry as WatchEntry);
    else read.bad.push(t("watch.csv.line", { line, why: wrong }));
  }
  return read;
}

function wrongWith({ path, format, group }: Record<keyof WatchEntry, string>): string | null {
  if (path === "") return t("watch.csv.nopath");
  if (path.length > 500) return t("watch.csv.longpath");
  if (!FORMATS.includes(format as Format)) return t("watch.csv.format", { format, known: FORMATS.join(", ") });
  return group.length > 100 ? t("watch.csv.group") : null;
}

interface Line {
  /** The line at which it begins. */
  line: number;
  cells: string[];
  /** An unclosed quote ends with its line, so that the other lines are read. */
  open: boolean;
}

/** Lines of cells; a quoted cell may contain the separator, line breaks, and two quotes for one. */
function records(text: string, separator: string): Line[] {
  const found: Line[] = [];
  let line = 1;
  for (let at = 0; at < text.length; ) {
    const one = record(text, at, separator);
    found.push({ line, cells: one.cells, open: one.open });
    line += text.slice(at, one.end).match(/\r\n|\n|\r/g)?.length ?? 0;
    at = one.end;
  }
  return found;
}

function record(text: string, from: number, separator: string): { cells: string[]; end: number; open: boolean } {
  const cells: string[] = [];
  let cell = "";
  let inside = false;
  let firstEnd = -1;
  for (let at = from; at < text.length; at += 1) {
    const c = text[at] as string;
    const ends = c === "\n" || c === "\r";
    const next = c === "\r" && text[at + 1] === "\n" ? at + 2 : at + 1;
    if (ends && firstEnd < 0) firstEnd = next;
    if (ends && !inside) return { cells: [...cells, cell], end: next, open: false };
    if (c === '"' && inside && text[at + 1] === '"') {
      cell += c;
      at += 1;
    } else if (c === '"' && (inside || cell === "")) inside = !inside;
    else if (c === separator && !inside) {
      cells.push(cell);
      cell = "";
    } else cell += c;
  }
  return { cells: [...cells, cell], end: inside && firstEnd >= 0 ? firstEnd : text.length, open: inside };
}
