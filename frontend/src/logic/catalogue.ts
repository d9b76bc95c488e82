/** The error catalogue as rows: filtered, folded, with tri-state boxes and what was tested. */
import type { ErrorGroup, ErrorHistoryRow, ErrorInfo } from "../wire/types";

export type ErrorStatus = ErrorHistoryRow["status"];
export type Check = "none" | "some" | "all";

export interface GroupRow {
  kind: "group";
  key: string;
  level: number;
  name: string;
  open: boolean;
  check: Check;
  ids: string[];
  tested: number;
}

export interface LeafRow {
  kind: "error";
  key: string;
  level: number;
  error: ErrorInfo;
  checked: boolean;
  status: ErrorStatus;
  code: string;
}

export type CatalogueRow = GroupRow | LeafRow;

export interface CatalogueView {
  filter: string;
  status: ErrorStatus | "all";
  closed: ReadonlySet<string>;
  checked: ReadonlySet<string>;
  history: ReadonlyMap<string, ErrorHistoryRow>;
}

/** The details of a generated error (`location=io-table-checksum, slot=3`) in the words of the catalogue. */
export function detailsInWords(error: ErrorInfo | undefined, details: string): string {
  return details
    .split(", ")
    .map((part) => {
      const [name, value] = part.split("=", 2);
      const detail = error?.details.find((known) => known.name === name);
      if (!detail || value === undefined) return part;
      const choice = detail.choices?.find((known) => known.id === value);
      return choice ? choice.description : `${detail.description || name} ${value}`;
    })
    .join(", ");
}

const REFERENCE = /(?<![\w-])([a-z][a-z0-9-]*)(?![\w-])(?: \(([^()]*=[^()]*)\))?/g;

/** What the server says of errors, with the catalogue's names for ids (`basic-io-error (rack=2)`), as a sentence. */
export function inNames(errors: readonly ErrorInfo[], message: string): string {
  const named = message.replace(REFERENCE, (whole, id: string, details: string | undefined) => {
    const error = errors.find((known) => known.id === id);
    if (!error) return whole;
    return details === undefined ? error.name : `${error.name} (${detailsInWords(error, details)})`;
  });
  return named.charAt(0).toUpperCase() + named.slice(1);
}

/** All errors of a catalogue, in its order. */
export function allErrors(groups: readonly ErrorGroup[]): ErrorInfo[] {
  return groups.flatMap((group) => [...allErrors(group.groups), ...group.errors]);
}

/** The rows to show; a group is left out when the filter leaves nothing of it. */
export function catalogueRows(groups: readonly ErrorGroup[], view: CatalogueView): CatalogueRow[] {
  return groups.flatMap((group) => groupRows(group, view, 0, ""));
}

function groupRows(group: ErrorGroup, view: CatalogueView, level: number, parent: string): CatalogueRow[] {
  const key = `${parent}/${group.name}`;
  const shown = allErrors([group]).filter((error) => passes(error, view));
  if (shown.length === 0) return [];
  const ids = shown.map((error) => error.id);
  const open = !view.closed.has(key) || view.filter !== "";
  const head: GroupRow = {
    kind: "group",
    key,
    level,
    name: group.name,
    open,
    check: checkOf(ids, view.checked),
    ids,
    tested: ids.filter((id) => statusOf(id, view) !== "never").length,
  };
  if (!open) return [head];
  const leaves = group.errors
    .filter((error) => passes(error, view))
    .map((error): LeafRow => leafRow(error, view, level + 1));
  return [head, ...group.groups.flatMap((inner) => groupRows(inner, view, level + 1, key)), ...leaves];
}

function leafRow(error: ErrorInfo, view: CatalogueView, level: number): LeafRow {
  const status = statusOf(error.id, view);
  const raised = view.history.get(error.id);
  return {
    kind: "error",
    key: error.id,
    level,
    error,
    checked: view.checked.has(error.id),
    status,
    code: status === "generated" && raised?.code ? raised.code : error.code,
  };
}

function statusOf(id: string, view: CatalogueView): ErrorStatus {
  return view.history.get(id)?.status ?? "never";
}

function passes(error: ErrorInfo, view: CatalogueView): boolean {
  if (view.status !== "all" && statusOf(error.id, view) !== view.status) return false;
  const wanted = view.filter.trim().toLowerCase();
  return [error.name, error.code, error.flag, error.id].some((text) => text.toLowerCase().includes(wanted));
}

function checkOf(ids: readonly string[], checked: ReadonlySet<string>): Check {
  const count = ids.filter((id) => checked.has(id)).length;
  if (count === 0) return "none";
  return count === ids.length ? "all" : "some";
}

/** What a click on a group's box does: all on, unless all were on. */
export function toggleAll(ids: readonly string[], checked: ReadonlySet<string>): Set<string> {
  const next = new Set(checked);
  const on = checkOf(ids, checked) !== "all";
  for (const id of ids) {
    if (on) next.add(id);
    else next.delete(id);
  }
  return next;
}

/** The details of an error as first shown: the default of each control, or its first choice, or its least number. */
export function defaultDetails(error: ErrorInfo): Record<string, string> {
  const entries = error.details.map((detail) => {
    const fallback = detail.control === "List" ? detail.choices?.[0]?.id : detail.minimum?.toString();
    return [detail.name, detail.default || (fallback ?? "")] as const;
  });
  return Object.fromEntries(entries);
}

/** The reason why an entry of a Spin control is not valid, or null. The server checks again. */
export function outOfRange(text: string, minimum: number | null, maximum: number | null, base: number): boolean {
  const digits = base === 16 ? /^[0-9a-f]+$/i : /^-?\d+$/;
  if (!digits.test(text.trim())) return true;
  const value = Number.parseInt(text, base);
  return (minimum !== null && value < minimum) || (maximum !== null && value > maximum);
}
