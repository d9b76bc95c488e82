/** Coverage line by line: what the gutter shows. */

import { t } from "../../text";
import type { Coverage, CoveredSite } from "../../wire/types";

interface CoveredLine {
  line: number;
  look: "full" | "part" | "none";
  says: string;
}

/** A line is partly covered when only some of its statements, or only some branches of a statement, were executed. */
export function linesOf(sites: readonly CoveredSite[]): CoveredLine[] {
  const lines = new Map<number, CoveredSite[]>();
  for (const site of sites) lines.set(site.line, [...(lines.get(site.line) ?? []), site]);
  return [...lines].sort(([a], [b]) => a - b).map(([line, here]) => ({ line, look: lookOf(here), says: sayOf(here) }));
}

function lookOf(sites: readonly CoveredSite[]): CoveredLine["look"] {
  if (sites.every((site) => !site.reached)) return "none";
  return sites.every((site) => site.reached && site.outcomes.every(({ taken }) => taken)) ? "full" : "part";
}

function sayOf(sites: readonly CoveredSite[]): string {
  const look = lookOf(sites);
  const missed = sites.flatMap((site) => (site.reached ? site.outcomes.filter(({ taken }) => !taken) : []));
  if (look !== "part") return t(`coverage.${look}`);
  if (missed.length === 0) return t("coverage.part");
  return t("coverage.missed", { ways: missed.map(({ name }) => name).join(", ") });
}

/** What is known of the innermost statement around a place; null where there is none. */
export function coveredAt(
  sites: readonly CoveredSite[],
  place: { line: number; column: number },
): Omit<CoveredLine, "line"> | null {
  const from = (line: number, column: number) => line - place.line || column - place.column;
  const around = sites
    .filter((site) => from(site.line, site.column) <= 0 && from(site.end_line, site.end_column) >= 0)
    .sort((a, b) => b.line - a.line || b.column - a.column);
  const [site] = around;
  return site ? { look: lookOf([site]), says: sayOf([site]) } : null;
}

/** The share of statements that were executed; null where there are none. */
export function shareOf(sites: readonly CoveredSite[]): number | null {
  return sites.length === 0 ? null : (100 * sites.filter(({ reached }) => reached).length) / sites.length;
}

export const sitesIn = (coverage: Coverage | null, file: string): readonly CoveredSite[] =>
  coverage?.files.find((covered) => covered.file === file)?.sites ?? [];
