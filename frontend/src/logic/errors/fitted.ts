/** Whether the hardware of an error is fitted: its instances that are have rows, and what the file does not say counts as fitted. */
import type { ErrorInfo, GenerateOne } from "../../wire/types";
import { idOf, isInstance, keyOf, type Rows } from "../plc/errorInstances";

export interface Known {
  /** The project says what is fitted. */
  known: boolean;
  instances: Rows;
  /** One row for each kind. */
  kinds: Rows;
}

export function isFitted(error: ErrorInfo, { details = {} }: GenerateOne, { known, instances, kinds }: Known): boolean {
  if (!known || instances.size === 0) return true;
  const identifying = error.details.filter(({ identifies }) => identifies !== "");
  if (!identifying.some(({ hardware }) => hardware !== "")) return kinds.get(error.id)?.fitted !== false;
  const named = identifying.map(({ name, default: usual }) => `${name}=${details[name] ?? usual}`);
  const row = instances.get(`${error.id}:${named.join(",")}`);
  return row !== undefined && row.fitted !== false;
}

/** What a sweep of these errors raises, and how many of them have nothing that is fitted. */
export function toRaise(errors: readonly ErrorInfo[], known: Known): { keys: string[]; absent: number } {
  const each = errors.map((error) => keysOf(error, known));
  return { keys: each.flat(), absent: each.filter((keys) => keys.length === 0).length };
}

/** The same of what is ticked: kinds, and single instances. */
export function tickedToRaise(ticked: ReadonlySet<string>, errors: readonly ErrorInfo[], known: Known) {
  const single = [...ticked].filter(isInstance);
  const there = single.filter((key) => !known.known || known.instances.get(key)?.fitted !== false);
  const kinds = toRaise(
    errors.filter(({ id }) => ticked.has(id)),
    known,
  );
  const keys = [...new Set([...kinds.keys, ...there])];
  const order = new Map(errors.map(({ id }, at) => [id, at]));
  keys.sort((a, b) => (order.get(idOf(a)) ?? 0) - (order.get(idOf(b)) ?? 0));
  return { keys, absent: kinds.absent + single.length - there.length };
}

function keysOf(error: ErrorInfo, { known, instances, kinds }: Known): string[] {
  if (!known) return [error.id];
  const counted = error.details.some(({ identifies, hardware }) => identifies !== "" && hardware !== "");
  if (!counted) return kinds.get(error.id)?.fitted === false ? [] : [error.id];
  const rows = [...instances.values()].filter((row) => row.id === error.id && row.fitted !== false);
  return rows.map(keyOf).filter(isInstance);
}
