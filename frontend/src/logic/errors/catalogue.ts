/** The error catalogue as rows: filtered, folded, with three-state boxes and the known reactions. */
import type { ErrorGroup, ErrorHistoryRow, ErrorInfo, ReactionState, Verdict } from "../../wire/types";
import { idOf, isOf, labelOf, type Rows } from "../plc/errorInstances";

export type ErrorStatus = ErrorHistoryRow["status"];
export type ErrorWay = ErrorHistoryRow["recovered_way"];
/** Filters by the known reaction; a finding is something that the program missed: nobody read the error, or reading it had no effect. */
export type ReactionFilter = "all" | "findings" | "unknown" | Exclude<Verdict, "reacted" | "stored_only">;
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
  /** Which of its kind, in words; empty: the row of the kind. */
  instance: string;
  /** What a click on its box ticks: itself, or the instances that are fitted. */
  keys: string[];
  check: Check;
  /** False: the hardware that the error is of is not fitted. */
  fitted: boolean;
  status: ErrorStatus;
  code: string;
  reaction: ReactionState | null;
  /** The reaction comes from a sweep. */
  swept: boolean;
  /** A scheduled or recurring fault raises this error. */
  armed: boolean;
}

export type CatalogueRow = GroupRow | LeafRow;

export interface CatalogueView {
  filter: string;
  status: ErrorStatus | "all";
  severity: ErrorInfo["severity"] | "all";
  reaction: ReactionFilter;
  closed: ReadonlySet<string>;
  checked: ReadonlySet<string>;
  history: ReadonlyMap<string, ErrorHistoryRow>;
  /** The rows of instances, by kind. */
  instances?: ReadonlyMap<string, readonly ErrorHistoryRow[]>;
  /** The project says what is fitted. */
  hardware?: boolean;
  armed: ReadonlySet<string>;
}

type CountView = Pick<CatalogueView, "hardware" | "history" | "instances">;

/** What decides which errors are shown. */
type FilterView = Pick<
  CatalogueView,
  "filter" | "status" | "severity" | "reaction" | "checked" | "history" | "instances"
>;

/** The details of a raised error (`location=io-table-checksum, slot=3`) with the texts of the catalogue. */
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

/** A message of the server about errors as a sentence, with ids (`basic-io-error (rack=2)`) replaced by the names of the
 * catalogue, and with what the project calls their units and numbers. */
export function inNames(errors: readonly ErrorInfo[], message: string, instances: Rows = new Map()): string {
  const named = message.replace(REFERENCE, (whole, id: string, details: string | undefined) => {
    const error = errors.find((known) => known.id === id);
    if (!error) return whole;
    if (details === undefined) return error.name;
    const label = labelOf(instances, id, details);
    return `${error.name} (${[label, detailsInWords(error, details)].filter(Boolean).join(", ")})`;
  });
  return named.charAt(0).toUpperCase() + named.slice(1);
}

/** All errors of a catalogue, in its order. */
export function allErrors(groups: readonly ErrorGroup[]): ErrorInfo[] {
  return groups.flatMap((group) => [...allErrors(group.groups), ...group.errors]);
}

/** The rows to show; a group that the filter leaves empty is omitted. */
export function catalogueRows(groups: readonly ErrorGroup[], view: CatalogueView): CatalogueRow[] {
  return groups.flatMap((group) => groupRows(group, view, 0, ""));
}

function groupRows(group: ErrorGroup, view: CatalogueView, level: number, parent: string): CatalogueRow[] {
  const key = `${parent}/${group.name}`;
  const shown = allErrors([group]).filter((error) => passes(error, view));
  if (shown.length === 0) return [];
  const ids = shown.flatMap((error) => keysOf(error, view));
  const open = !view.closed.has(key) || view.filter.trim() !== "";
  const head: GroupRow = {
    kind: "group",
    key,
    level,
    name: group.name,
    open,
    check: checkOf(ids, view.checked),
    ids,
    tested: shown.flatMap((error) => rowsOf(error, view)).filter(isTested).length,
  };
  if (!open) return [head];
  const leaves = group.errors
    .filter((error) => passes(error, view))
    .flatMap((error): LeafRow[] => leafRows(error, view, level + 1));
  return [head, ...group.groups.flatMap((inner) => groupRows(inner, view, level + 1, key)), ...leaves];
}

/** What a box of the error ticks: where the project says what is fitted, just that. */
function keysOf(error: ErrorInfo, view: CountView): string[] {
  const fitted = (view.instances?.get(error.id) ?? []).filter((row) => row.fitted !== false);
  if (view.hardware && fitted.length > 0) return fitted.map((row) => row.instance ?? row.id);
  return view.history.get(error.id)?.fitted === false ? [] : [error.id];
}

/** The rows that are counted. */
function rowsOf(error: ErrorInfo, view: CountView): ErrorHistoryRow[] {
  const fitted = (view.instances?.get(error.id) ?? []).filter((row) => row.fitted !== false);
  if (view.hardware && fitted.length > 0) return fitted;
  const kind = view.history.get(error.id);
  return kind && kind.fitted !== false ? [kind] : [];
}

/** The row of a kind, and below it those of its instances. */
function leafRows(error: ErrorInfo, view: CatalogueView, level: number): LeafRow[] {
  const kind = leafRow(error, view, level, view.history.get(error.id), error.id);
  const instances = (view.instances?.get(error.id) ?? []).map((row) => {
    const key = row.instance ?? row.id;
    // What people call it comes first: where both do not fit, the number is cut.
    const words = [row.label, detailsInWords(error, key.slice(row.id.length + 1).replaceAll(",", ", "))];
    return { ...leafRow(error, view, level + 1, row, key), instance: words.filter(Boolean).join(", "), keys: [key] };
  });
  return [kind, ...instances];
}

function leafRow(
  error: ErrorInfo,
  view: CatalogueView,
  level: number,
  raised: ErrorHistoryRow | undefined,
  key: string,
): LeafRow {
  const status = raised?.status ?? "never";
  const keys = key === error.id ? keysOf(error, view) : [key];
  return {
    kind: "error",
    key,
    level,
    error,
    instance: "",
    keys,
    check: checkOf(keys, view.checked),
    fitted: raised?.fitted !== false,
    status,
    code: status === "generated" && raised?.code ? raised.code : error.code,
    reaction: reactionOf(raised),
    swept: isSwept(raised),
    armed: [...view.armed].some((text) => isOf(text, key)),
  };
}

/** Of all that is counted, how much is tested: instances that are fitted, and kinds of which none is known. */
export function testedOf(errors: readonly ErrorInfo[], view: CountView) {
  const rows = errors.flatMap((error) => rowsOf(error, view));
  const ids = errors.flatMap((error) => keysOf(error, view));
  return { tested: rows.filter(isTested).length, total: ids.length };
}

/** An error is tested when the reaction of the program is known. */
function isTested(row: ErrorHistoryRow | undefined): boolean {
  return verdictOf(row) !== null;
}

type Told = Pick<ErrorHistoryRow, "reaction" | "swept"> | undefined;

/** The known reaction: from the last time that the error was raised here, else from a sweep. */
export const reactionOf = (row: Told): ReactionState | null => row?.reaction ?? row?.swept ?? null;

export const isSwept = (row: Told): boolean => !row?.reaction && Boolean(row?.swept);

export function verdictOf(row: Told): Verdict | null {
  const reaction = reactionOf(row);
  return reaction?.state === "done" ? reaction.verdict : null;
}

/** What is no finding: the error acted or decided, or no program could react. */
const HANDLED: readonly Verdict[] = ["acted", "decided", "reacted", "stopped"];

/** A finding: nobody read the error, or it was read, kept or displayed, and decided nothing. */
export const isFinding = (
  verdict: Verdict | null,
): verdict is Exclude<Verdict, "acted" | "decided" | "reacted" | "stopped"> =>
  verdict !== null && !HANDLED.includes(verdict);

function statusOf(id: string, view: FilterView): ErrorStatus {
  return view.history.get(id)?.status ?? "never";
}

/** What is ticked although the filters hide it: nothing of it is raised or recovered unseen. */
export function hiddenKeys(errors: readonly ErrorInfo[], view: FilterView): string[] {
  const shown = new Set(errors.filter((error) => passes(error, view)).map(({ id }) => id));
  return [...view.checked].filter((key) => !shown.has(idOf(key)));
}

function passes(error: ErrorInfo, view: FilterView): boolean {
  if (view.status !== "all" && statusOf(error.id, view) !== view.status) return false;
  if (view.severity !== "all" && error.severity !== view.severity) return false;
  if (!reactionPasses(verdictOf(view.history.get(error.id)), view.reaction)) return false;
  const wanted = view.filter.trim().toLowerCase();
  const names = (error.wordings ?? []).map((wording) => wording.name);
  const labels = (view.instances?.get(error.id) ?? []).map((row) => row.label ?? "");
  const texts = [error.name, ...names, error.code, error.flag, error.id, ...labels];
  return texts.some((text) => text.toLowerCase().includes(wanted));
}

function reactionPasses(verdict: Verdict | null, wanted: ReactionFilter): boolean {
  if (wanted === "all") return true;
  if (wanted === "findings") return isFinding(verdict);
  return wanted === "unknown" ? verdict === null : verdict === wanted;
}

function checkOf(ids: readonly string[], checked: ReadonlySet<string>): Check {
  const count = ids.filter((id) => checked.has(id)).length;
  if (count === 0) return "none";
  return count === ids.length ? "all" : "some";
}

/** A click on the box of a group ticks all of its errors, or clears them if all were ticked. */
export function toggleAll(ids: readonly string[], checked: ReadonlySet<string>): Set<string> {
  const next = new Set(checked);
  const on = checkOf(ids, checked) !== "all";
  for (const id of ids) {
    if (on) next.add(id);
    else next.delete(id);
  }
  return next;
}

/** The row to select for typed letters: the next row after `from` whose name, code or flag begins with them. */
export function rowFor(rows: readonly CatalogueRow[], typed: string, from: number): CatalogueRow | undefined {
  const wanted = typed.toLowerCase();
  const inTurn = [...rows.slice(from), ...rows.slice(0, from)];
  return inTurn.find((row) => textsOf(row).some((text) => text.toLowerCase().startsWith(wanted)));
}

function textsOf(row: CatalogueRow): string[] {
  if (row.kind === "group") return [row.name];
  return row.instance ? [row.instance, row.code] : [row.error.name, row.error.code, row.error.flag];
}
