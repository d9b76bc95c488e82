/** The columns of a controller log and how they are mapped. Pure functions: nothing is lost whatever goes wrong. */
import type { NewTraceVerification, TraceColumnMap, TraceMapping, TraceProblem } from "../../wire/types";

export const ROLES = ["input", "output", "ignore"] as const;
export const UNITS = ["scan", "ns", "us", "ms", "s"] as const;
export const GAPS = ["refuse", "skip", "hold"] as const;
export const SAMPLED = ["end", "begin"] as const;

/** A column that is not used. */
export const unused = (column: string): TraceColumnMap => ({
  column,
  path: "",
  role: "ignore",
  absolute: 0,
  relative: 0,
  late_ms: 0,
});

const columnIn = (mapping: TraceMapping, name: string) => mapping.columns.find(({ column }) => column === name);

/** A mapping of every column of the file, in its order: as given, else not used. */
export function complete(mapping: TraceMapping, columns: readonly string[]): TraceMapping {
  return {
    ...mapping,
    axis: columns.includes(mapping.axis) ? mapping.axis : "",
    columns: columns
      .filter((name) => name !== mapping.axis)
      .map((column) => columnIn(mapping, column) ?? unused(column)),
  };
}

/** After a different file, or the same one corrected: manual changes stay, the rest is proposed again. */
export function carryOver(
  before: { mapping: TraceMapping; proposal: TraceMapping } | null,
  proposal: TraceMapping,
  columns: readonly string[],
): TraceMapping {
  const fresh = complete(proposal, columns);
  if (before === null) return fresh;
  const kept = <T>(now: T, proposed: T, next: T) => (now === proposed ? next : now);
  const axis = kept(before.mapping.axis, before.proposal.axis, fresh.axis);
  return complete(
    {
      axis: columns.includes(axis) || axis === "" ? axis : fresh.axis,
      unit: kept(before.mapping.unit, before.proposal.unit, fresh.unit),
      gaps: kept(before.mapping.gaps, before.proposal.gaps, fresh.gaps),
      sampled: kept(before.mapping.sampled, before.proposal.sampled, fresh.sampled),
      columns: columns.flatMap((name) => {
        const mine = columnIn(before.mapping, name);
        const changed = mine && !isSame(mine, columnIn(before.proposal, name));
        return (changed ? mine : columnIn(fresh, name)) ?? [];
      }),
    },
    columns,
  );
}

const isSame = (one: TraceColumnMap, other: TraceColumnMap | undefined): boolean =>
  other !== undefined &&
  (["path", "role", "absolute", "relative", "late_ms"] as const).every((each) => one[each] === other[each]);

/** The column is used, and its mapping is still the proposed one. */
export function isProposed(row: TraceColumnMap, proposal: TraceMapping): boolean {
  const proposed = columnIn(proposal, row.column);
  return row.role !== "ignore" && row.path !== "" && row.path === proposed?.path && row.role === proposed.role;
}

/** What somebody allows an output to differ by. */
export const hasTolerance = ({ absolute, relative, late_ms }: TraceColumnMap) =>
  absolute > 0 || relative > 0 || late_ms > 0;

/** A number as it was typed: empty is 0; null: it is none, or not within these bounds. */
export function bounded(text: string, most: number): number | null {
  const plain = text.trim().replace(",", ".");
  const value = plain === "" ? 0 : Number(plain);
  return Number.isFinite(value) && value >= 0 && value <= most ? value : null;
}

/** Applies a saved mapping to this file: what it says about columns of the file, and the columns that the file does not have. */
export function takeSaved(saved: TraceMapping, columns: readonly string[]): { mapping: TraceMapping; lost: string[] } {
  const wanted = [saved.axis, ...saved.columns.filter(({ role }) => role !== "ignore").map(({ column }) => column)];
  const lost = wanted.filter((name) => name !== "" && !columns.includes(name));
  return { mapping: complete(saved, columns), lost };
}

/** A column that gets a variable is used: as an input, unless somebody says otherwise. */
export function changeColumn(mapping: TraceMapping, name: string, change: Partial<TraceColumnMap>): TraceMapping {
  const columns = mapping.columns.map((row) => {
    if (row.column !== name) return row;
    const next = { ...row, ...change };
    const nowUsed = row.path === "" && next.path !== "" && row.role === "ignore";
    return nowUsed && change.role === undefined ? { ...next, role: "input" as const } : next;
  });
  return { ...mapping, columns };
}

/** Chooses a different axis; the old axis is an ordinary column again. */
export function changeAxis(mapping: TraceMapping, axis: string, columns: readonly string[]): TraceMapping {
  return complete({ ...mapping, axis }, columns);
}

/** The first values of a column. */
export function firstValues(sample: readonly (readonly string[])[], index: number, most = 4): string {
  return sample
    .slice(0, most)
    .map((row) => row[index] || "–")
    .join(" · ");
}

export function countRoles({ columns }: TraceMapping): { inputs: number; outputs: number } {
  const count = (role: TraceColumnMap["role"]) => columns.filter((row) => row.role === role).length;
  return { inputs: count("input"), outputs: count("output") };
}

/** The problems of each column; a problem of a cell counts for its column, too. */
export function byColumn(problems: readonly TraceProblem[]): ReadonlyMap<string, readonly TraceProblem[]> {
  const found = new Map<string, TraceProblem[]>();
  for (const problem of problems) {
    if (problem.column === "") continue;
    const known = found.get(problem.column);
    if (known) known.push(problem);
    else found.set(problem.column, [problem]);
  }
  return found;
}

/** The range of a verification that is a whole POU; empty: the whole program. */
export function rangeOf(pou: string): NonNullable<NewTraceVerification["range"]> {
  return { pou, file: "", first: 0, last: 0, instance: "" };
}
