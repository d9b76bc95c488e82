/** Required reactions: the lines of `required.reactions` that are about one error, and what became of each requirement. */

import { t } from "../../text";
import type { Reaction } from "../../wire/types";

export const REQUIREMENTS = "required.reactions";

type Required = Reaction["required"][number];

interface Block {
  /** Indices of the first line, and of that after the last. */
  from: number;
  to: number;
  lines: string[];
}

/** What the file says of an error in any state: without the space at the beginning of its lines. Empty: nothing. */
export function requiredOf(text: string, error: string): string {
  return find(text.split("\n"), error)?.lines.join("\n") ?? "";
}

/** The number of the line of the error in the file, from 1; null when it has none. */
export function lineOf(text: string, error: string): number | null {
  const found = find(text.split("\n"), error);
  return found && found.from + 1;
}

/** The text with other lines for an error; all else stays as it is. */
export function withRequired(text: string, error: string, said: string): string {
  const lines = text.split("\n");
  const found = find(lines, error);
  const wanted = said.replace(/\s+$/, "");
  const block = wanted ? [`${error}:`, ...wanted.split("\n").map((line) => (line.trim() ? `  ${line}` : ""))] : [];
  if (found) {
    lines.splice(found.from, found.to - found.from, ...block);
    return lines.join("\n");
  }
  if (block.length === 0) return text;
  const before = text.replace(/\s+$/, "");
  return `${before}${before ? "\n\n" : ""}${block.join("\n")}\n`;
}

/** Whether the file speaks of the error in several places: which of them somebody wants to edit only the file can say. */
export const isSplit = (text: string, error: string): boolean => headsOf(bare(text), error).length > 1;

function find(lines: readonly string[], error: string): Block | null {
  const said = bare(lines.join("\n"));
  const [from] = headsOf(said, error);
  const first = from === undefined ? undefined : lines[from];
  if (from === undefined || first === undefined) return null;
  let to = from + 1;
  // A comment in the first column ends nothing: what is indented below it still belongs to the error.
  for (let at = to; at < lines.length && !/^\S/.test(said[at] ?? ""); at += 1)
    if (said[at]?.trim() || /^\s+(\/\/|\(\*)/.test(lines[at] ?? "")) to = at + 1;
  const rest = first.slice(error.length + 1).trim();
  const inside = lines.slice(from + 1, to).map((line) => line.replace(/^( {1,2}|\t)/, ""));
  return { from, to, lines: rest ? [rest, ...inside] : inside };
}

function headsOf(said: readonly string[], error: string): number[] {
  const isHead = (line: string) => line.startsWith(`${error}:`) && /^(\s|$)/.test(line.slice(error.length + 1));
  return said.flatMap((line, at) => (isHead(line) ? [at] : []));
}

const QUOTED_OR_COMMENT = /'(?:\$.|[^$'\n])*'|"(?:\$.|[^$"\n])*"|\/\/[^\n]*|\(\*[\s\S]*?\*\)/g;

/** The lines with blanks in place of comments, as the compiler reads them. */
function bare(text: string): string[] {
  const blanked = text.replace(QUOTED_OR_COMMENT, (found) =>
    /^['"]/.test(found) ? found : found.replace(/[^\n]/g, " "),
  );
  return blanked.split("\n");
}

/** Whether it is not as the project requires it. */
export const isUnmet = ({ outcome, reason }: Required): boolean =>
  outcome === "failed" || ["window", "invalid", "ended", "not_recovered", "not_raised", "no_state"].includes(reason);

/** Whether nothing was run for it, as the error did not come. */
export const isUntried = ({ reason }: Required): boolean => ["not_raised", "no_state", "present"].includes(reason);

/** The scan and the values that decided it, or why nothing was checked. */
export function evidenceOf({ outcome, scan, recovery, values, note, reason }: Required): string {
  if (outcome === "not_checked") {
    if (reason === "stopped" || reason === "other_state") return t(`required.reason.${reason}`);
    return note;
  }
  const shown = values.map(({ path, value }) =>
    path === "verdict" ? t("required.verdict", { value: inWords(value) }) : `${path} = ${value}`,
  );
  const at = scan === null ? "" : t(recovery ? "required.after" : "required.scan", { scan });
  return [at, shown.join(", ")].filter(Boolean).join(": ");
}

const VERDICTS = [
  "acted",
  "decided",
  "displayed",
  "stored",
  "no_effect",
  "not_reached",
  "never_read",
  "stopped",
] as const;

function inWords(value: string): string {
  const known = VERDICTS.find((verdict) => verdict === value);
  return known ? t(`verdict.${known}`) : value;
}
