/** What changed, who wrote, where two runs diverge: functions for the panels about the past. */
import type { Comparison, Instance, RunChanges, VariableChange } from "../../wire/types";
import type { Axis } from "../plc/timeline";

/** Every word must occur in the path, the type or one of the values. */
export function filterChanges(changes: readonly VariableChange[], filter: string): VariableChange[] {
  const wanted = filter.toLowerCase().split(/\s+/).filter(Boolean);
  if (wanted.length === 0) return [...changes];
  return changes.filter(({ path, type, before_shown: before, after_shown: after }) => {
    const text = `${path} ${type} ${before} ${after}`.toLowerCase();
    return wanted.every((word) => text.includes(word));
  });
}

/** For a spreadsheet: one line for each variable. */
export function changesAsText(changes: readonly VariableChange[], heads: readonly [string, string]): string {
  const rows = changes.map(({ path, type, before_shown: before, after_shown: after }) => [path, type, before, after]);
  return [["Variable", "Type", ...heads], ...rows].map((row) => row.map(cell).join("\t")).join("\n");
}

const cell = (text: string) => text.replace(/[\t\r\n]+/g, " ");

/** Two typed scans, the earlier one first; null when one of them is not a scan. */
export function ordered(one: number | null, other: number | null): Axis | null {
  if (one === null || other === null) return null;
  return { from: Math.min(one, other), to: Math.max(one, other) };
}

/** Instances of the same project come first; among these, first those that are named after this one: its branches. */
export function compareWith(here: Instance, all: readonly Instance[]): Instance[] {
  const stem = stemOf(here.name);
  const rank = (other: Instance) =>
    other.project.id !== here.project.id ? 2 : stemOf(other.name) === stem || other.name.startsWith(stem) ? 0 : 1;
  const fits = ({ id, project }: Instance) => id !== here.id && project.model === here.project.model;
  return all.filter(fits).sort((a, b) => rank(a) - rank(b) || b.id - a.id);
}

const stemOf = (name: string) => name.replace(/-\d+$/, "");

type Verdict = "underway" | "failed" | "same" | "partly" | "nothing" | "apart";

export function verdictOf({ result, message }: Comparison): Verdict {
  if (message !== "") return "failed";
  if (result === null) return "underway";
  if (result.scan !== null) return "apart";
  return result.same === "partly" || result.same === "nothing" ? result.same : "same";
}

/** The newest state of each comparison or replay; the newest one first. */
export function withNewest<T extends { id: number }>(known: readonly T[], told: T): T[] {
  return [told, ...known.filter(({ id }) => id !== told.id)].sort((a, b) => b.id - a.id);
}

/** How far something is: 0 to 1. */
export const shareOf = ({ done, of }: { done: number; of: number }) => (of > 0 ? Math.min(1, done / of) : 0);

/** Not all of them are listed. */
export const leftOut = ({ changes, count }: RunChanges) => Math.max(0, count - changes.length);

const WORD = /[\w-]+/g;

/** The errors that a mark or an entry mentions, by their ids. */
export function errorsIn(text: string, ids: ReadonlySet<string>): string[] {
  return [...new Set(text.match(WORD) ?? [])].filter((word) => ids.has(word));
}
