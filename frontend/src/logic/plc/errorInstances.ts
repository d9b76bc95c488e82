/** Error instances: unit 3 and unit 20 of one kind, each with a row of its own. Its key is what the server recovers: `fal:number=5`. */
import type { DeviceDetail, ErrorHistoryRow, GenerateOne } from "../../wire/types";

export type Rows = ReadonlyMap<string, ErrorHistoryRow>;

export const keyOf = (row: ErrorHistoryRow): string => row.instance || row.id;

export const isInstance = (key: string): boolean => key.includes(":");

export const idOf = (key: string): string => key.split(":", 1)[0] ?? key;

/** Whether a key is that of an instance, or of one of a kind. */
export const isOf = (key: string, instanceOrKind: string): boolean =>
  key === instanceOrKind || (!isInstance(instanceOrKind) && idOf(key) === instanceOrKind);

/** The rows with those that changed; the row of a kind goes when its first instance is known. */
export function withRows(before: Rows, changed: readonly ErrorHistoryRow[]): Map<string, ErrorHistoryRow> {
  const next = new Map(before);
  for (const row of changed) {
    if (isInstance(keyOf(row))) next.delete(row.id);
    next.set(keyOf(row), row);
  }
  return next;
}

const STATUS = { generated: 2, cleared: 1, never: 0 };

/** One row for each kind: the instance that is present and came last speaks for it, and all of them are counted. */
export function byKind(instances: Rows): Map<string, ErrorHistoryRow> {
  const kinds = new Map<string, ErrorHistoryRow>();
  for (const row of instances.values()) {
    const other = kinds.get(row.id);
    const first = other && !speaksFor(row, other) ? other : row;
    const count = row.count + (other?.count ?? 0);
    kinds.set(row.id, {
      ...first,
      count,
      fitted: row.fitted !== false || (other !== undefined && other.fitted !== false),
    });
  }
  return kinds;
}

function speaksFor(row: ErrorHistoryRow, other: ErrorHistoryRow): boolean {
  if (row.status !== other.status) return STATUS[row.status] > STATUS[other.status];
  return (row.generated_scan ?? -1) > (other.generated_scan ?? -1);
}

/** The rows of instances by kind, in the order of their numbers. */
export function instancesByKind(instances: Rows): Map<string, ErrorHistoryRow[]> {
  const found = new Map<string, ErrorHistoryRow[]>();
  for (const row of instances.values()) {
    if (isInstance(keyOf(row))) found.set(row.id, [...(found.get(row.id) ?? []), row]);
  }
  for (const rows of found.values()) rows.sort((a, b) => keyOf(a).localeCompare(keyOf(b), "en", { numeric: true }));
  return found;
}

/** What the project calls the unit or the number of an error with these details (`number=42`); empty where it says nothing. */
export function labelOf(instances: Rows, id: string, details: string): string {
  const given = new Set(details.split(", "));
  const named = [...instances.values()].find(
    (row) => row.label && row.id === id && pairsIn(keyOf(row)).every((pair) => given.has(pair)),
  );
  return named?.label ?? "";
}

const pairsIn = (key: string): string[] => key.slice(idOf(key).length + 1).split(",");

/** The details in the key of an instance, as the history has them: `rack=2, slot=3`. */
export const detailsIn = (key: string): string => pairsIn(key).join(", ");

/** What raises just this instance. */
export function wantedOf(key: string): GenerateOne {
  return { id: idOf(key), details: Object.fromEntries(pairsIn(key).map((pair) => pair.split("=", 2))) };
}

/** The row of what the device shows: of one unit where several of a kind can be present, else of the kind. */
export function rowOf(instances: Rows, id: string, details: readonly DeviceDetail[]): ErrorHistoryRow | undefined {
  const shown = new Map(details.map(({ name, value }) => [name, value]));
  const isShown = (key: string) =>
    Object.entries(wantedOf(key).details ?? {}).every(([name, value]) => shown.get(name) === value);
  return [...instances.values()].find((row) => row.id === id && (!isInstance(keyOf(row)) || isShown(keyOf(row))));
}
