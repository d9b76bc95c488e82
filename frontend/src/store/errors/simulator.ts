/** The selection and the entries of the error simulator, and its commands. */

import { create } from "zustand";
import { type ErrorStatus, hiddenKeys, type ReactionFilter, toggleAll } from "../../logic/errors/catalogue";
import {
  canBeSeveral,
  defaultEntries,
  type Entries,
  type Entry,
  entriesIn,
  needsDetails,
  wireDetails,
} from "../../logic/errors/details";
import { isPlain, plainShape, readShape, type ShapeForm } from "../../logic/errors/shapes";
import { detailsIn, idOf, instancesByKind, isInstance, keyOf, wantedOf } from "../../logic/plc/errorInstances";
import { withName } from "../../logic/plc/expression";
import { send } from "../../wire/send";
import type { ErrorHistoryRow, ErrorInfo, GenerateOne } from "../../wire/types";
import { readClock } from "../plc/clock";
import { usePlc } from "../plc/plc";
import { onInstanceChange } from "../plc/reset";
import { catalogueNow } from "./catalogue";
import { isFittedNow } from "./hardware";
import { recoverErrors } from "./recovering";

export interface Outcome {
  ok: boolean;
  message: string;
  /** The errors that it is about. */
  ids: readonly string[];
  /** Those of them that are generated already: generating them again changes their details. */
  present: readonly string[];
  /** Known names that are similar to the unknown one. */
  near: readonly string[];
  /** What was refused because it is not fitted, and can be raised anyway: the device reports it all the same. */
  absent: readonly GenerateOne[];
}

interface Simulator {
  filter: string;
  status: ErrorStatus | "all";
  severity: ErrorInfo["severity"] | "all";
  reaction: ReactionFilter;
  closed: ReadonlySet<string>;
  checked: ReadonlySet<string>;
  selected: string | null;
  /** Details as edited, by error; other errors have their defaults. */
  details: Readonly<Record<string, Entries>>;
  /** When the next fault begins and how it continues. */
  shape: ShapeForm;
  /** The errors of the open dialog for several errors; null while it is closed. */
  asking: readonly string[] | null;
  outcome: Outcome | null;
  /** The errors that the message is about, with their state: it is valid while they stay in this state. */
  told: { ids: readonly string[]; status: ErrorStatus } | null;
}

const nothing: Simulator = {
  filter: "",
  status: "all",
  severity: "all",
  reaction: "all",
  closed: new Set(),
  checked: new Set(),
  selected: null,
  details: {},
  shape: plainShape,
  asking: null,
  outcome: null,
  told: null,
};

export const useSimulator = create<Simulator>(() => nothing);
const get = useSimulator.getState;
const set = useSimulator.setState;

onInstanceChange(() => set(nothing));

type Filters = Pick<Simulator, "filter" | "status" | "severity" | "reaction">;
export const setFilters = (filters: Partial<Filters>) => set(filters);
export function selectError(selected: string | null): void {
  const before = get().selected;
  // What an instance was raised with are not the details of its kind.
  if (before !== null && before !== selected && isInstance(before))
    set(({ details: { [idOf(before)]: _, ...details } }) => ({ details }));
  set({ selected, outcome: null });
  const row = selected !== null && isInstance(selected) ? usePlc.getState().instances.get(selected) : undefined;
  const error = row && catalogueNow().byId.get(row.id);
  // The details of the instance are those that are shown, and raised.
  if (row && error) set(({ details }) => ({ details: { ...details, [error.id]: entriesIn(error, row.details) } }));
}
export const setShape = (change: Partial<ShapeForm>) => set(({ shape }) => ({ shape: { ...shape, ...change } }));
export const closeDialog = () => set({ asking: null });
export const forgetOutcome = () => set({ outcome: null });

/** Replaces an unknown name in the condition by a known one. */
export function mendCondition({ message }: Outcome, name: string): void {
  const { shape } = get();
  const field = shape.when === "condition" ? "condition" : "acknowledge";
  set({ shape: { ...shape, [field]: withName(shape[field], message, name) }, outcome: null });
}

export function toggleChecked(ids: readonly string[]): void {
  set(({ checked }) => ({ checked: toggleAll(ids, checked), outcome: null }));
}

export function toggleGroup(key: string): void {
  set(({ closed }) => {
    const next = new Set(closed);
    if (!next.delete(key)) next.add(key);
    return { closed: next };
  });
}

/** Details as edited; else those of the present error, else its defaults. */
export function entriesOf(
  { details }: Pick<Simulator, "details">,
  error: ErrorInfo,
  row: ErrorHistoryRow | undefined,
): Entries {
  return details[error.id] ?? (row?.status === "generated" ? entriesIn(error, row.details) : defaultEntries(error));
}

const entriesNow = (error: ErrorInfo) => entriesOf(get(), error, usePlc.getState().errors.get(error.id));

export function setDetail(error: ErrorInfo, name: string, entry: Entry): void {
  setEntries(error, { ...entriesNow(error), [name]: entry });
}

export function setEntries(error: ErrorInfo, entries: Entries): void {
  set(({ details }) => ({ details: { ...details, [error.id]: entries } }));
}

type Ticked = Filters & Pick<Simulator, "checked">;
type Chosen = Ticked & Pick<Simulator, "selected">;

/** What is ticked and hidden by the filters. */
export function hiddenOf({ filter, status, severity, reaction, checked }: Ticked): string[] {
  if (checked.size === 0 || (filter.trim() === "" && status === "all" && severity === "all" && reaction === "all"))
    return [];
  const { errors: history, instances: known } = usePlc.getState();
  const instances = instancesByKind(known);
  return hiddenKeys(catalogueNow().errors, { filter, status, severity, reaction, checked, history, instances });
}

/** What is ticked and shown. */
function shownOf(state: Ticked, hidden = hiddenOf(state)): string[] {
  return [...state.checked].filter((key) => !hidden.includes(key));
}

export const showAll = () => set({ filter: "", status: "all", severity: "all", reaction: "all" });

/** What is hidden is ticked no more. */
export const untickHidden = () => set((state) => ({ checked: new Set(shownOf(state)) }));

export const untickAll = () => set({ checked: new Set(), outcome: null });

/** The errors that the buttons act on: the ticked ones that are shown, else the selected one; the key of a group begins with a slash. */
export function targets(state: Chosen): string[] {
  const hidden = hiddenOf(state);
  const shown = shownOf(state, hidden);
  if (shown.length > 0) return shown;
  const { selected } = state;
  return selected === null || selected.startsWith("/") || hidden.includes(selected) ? [] : [selected];
}

/** Details of several errors are edited in a dialog; those of one are edited in the panel, unless it shows a different error. */
export function asksFirst(state: Chosen, errors: readonly ErrorInfo[]): boolean {
  const chosen = chosenOf(state, errors);
  const selected = state.selected === null ? null : idOf(state.selected);
  if (chosen.length === 1 && chosen[0]?.id === selected) return false;
  return chosen.some(needsDetails);
}

/** The errors that the buttons act on with the details that are shown or asked for, in the order of the catalogue. */
export function chosenOf(state: Chosen, errors: readonly ErrorInfo[]): ErrorInfo[] {
  const single = new Set(instancesOf(state));
  const wanted = new Set(
    targets(state)
      .filter((key) => !single.has(key))
      .map(idOf),
  );
  return errors.filter((error) => wanted.has(error.id));
}

/** The ticked instances that are raised with their own details. Of a kind that can be present only once, several are none of them: which one is asked. */
export function instancesOf(state: Ticked): string[] {
  const { byId } = catalogueNow();
  const shown = shownOf(state);
  return shown.filter((key) => {
    const error = byId.get(idOf(key));
    const alone = !shown.some((other) => other !== key && idOf(other) === idOf(key));
    return isInstance(key) && (alone || !error || canBeSeveral(error));
  });
}

/** What the buttons raise, as it is sent. */
export function wantedNow(state: Chosen, errors: readonly ErrorInfo[]): GenerateOne[] {
  return [...asWanted(chosenOf(state, errors)), ...instancesOf(state).map(singleWanted)];
}

/** An instance with its own details; the selected one has those that are shown and may be edited. */
function singleWanted(key: string): GenerateOne {
  const error = key === get().selected ? catalogueNow().byId.get(idOf(key)) : undefined;
  return (error && asWanted([error])[0]) ?? wantedOf(key);
}

/** Opens the dialog for these errors, whether they need details or not. */
export function askDetails(errors: readonly ErrorInfo[]): void {
  const chosen = chosenOf(get(), errors);
  if (chosen.length === 0) return;
  // Of several ticked instances of a kind that can be present only once, the first is proposed.
  const first = Object.fromEntries(
    chosen.flatMap((error) => {
      const key = targets(get()).find((each) => isInstance(each) && idOf(each) === error.id);
      return key && !get().details[error.id] ? [[error.id, entriesIn(error, detailsIn(key))] as const] : [];
    }),
  );
  set(({ details }) => ({
    details: { ...details, ...first },
    asking: chosen.map((error) => error.id),
    outcome: null,
  }));
}

/** Raises these errors; opens the dialog first if several need details. */
export async function generate(errors: readonly ErrorInfo[]): Promise<void> {
  if (asksFirst(get(), errors)) askDetails(errors);
  else await raise(chosenOf(get(), errors), { single: instancesOf(get()) });
}

const asWanted = (errors: readonly ErrorInfo[]): GenerateOne[] =>
  errors.map((error) => ({ id: error.id, details: wireDetails(error, entriesNow(error)) }));

/** Raises these errors in one seam, or arms them if they come later, one by one or temporarily. True when it was accepted. */
export async function raise(
  errors: readonly ErrorInfo[],
  { gap = 0, again = false, single = [] as readonly string[] } = {},
): Promise<boolean> {
  const wanted = [...asWanted(errors), ...single.map(singleWanted)];
  const about = [...errors.map(({ id }) => id), ...single];
  if (wanted.length === 0) return false;
  const { shape: form } = get();
  if (again || (isPlain(form) && gap === 0))
    return report(send({ type: "generate", errors: wanted, again, anyway: false }), about, wanted);
  const { start, shape, troubles } = readShape(form, readClock().scan);
  if (Object.keys(troubles).length > 0) return false;
  const accepted = await report(send({ type: "arm", errors: wanted, start, shape, gap }), about);
  // The form returns to an ordinary Generate for the next error.
  if (accepted) set(({ shape: now }) => ({ shape: { ...now, when: "now", how: "stay" } }));
  return accepted;
}

/** Repeats a Generate that was refused because some errors are present: present errors get the details that are shown now. */
export async function changeDetails(errors: readonly ErrorInfo[], outcome: Outcome): Promise<boolean> {
  const ids = new Set(outcome.ids);
  return raise(
    errors.filter((error) => ids.has(error.id)),
    { again: true },
  );
}

/** Repeats a Generate that was refused because some errors are present, without those. */
export async function skipPresent(errors: readonly ErrorInfo[], outcome: Outcome): Promise<boolean> {
  const ids = new Set(outcome.ids);
  const wanted = errors.filter((error) => ids.has(error.id));
  const single = outcome.ids.filter(isInstance);
  return report(
    send({ type: "generate_absent", errors: [...asWanted(wanted), ...single.map(singleWanted)] }),
    outcome.ids,
  );
}

/** Recovers those of the chosen errors that are generated; `everything` recovers all errors. */
export async function recover(everything: boolean): Promise<void> {
  const { instances } = usePlc.getState();
  const present = [...instances.values()].filter((row) => row.status === "generated").map(keyOf);
  const ids = everything
    ? present
    : targets(get()).filter((key) => present.some((each) => each === key || idOf(each) === key));
  if (await report(recoverErrors(everything ? null : ids))) set({ told: { ids, status: "cleared" } });
}

/** Cancels faults; null cancels all of them. */
export async function disarm(ids: number[] | null): Promise<void> {
  await report(send({ type: "disarm", ids }));
}

/** Leaves a fatal stop: recovers the fatal errors, the others stay. True when it was done. */
export async function clearFatal(): Promise<boolean> {
  const rows = [...usePlc.getState().errors.values()];
  const ids = rows.filter((row) => row.status === "generated" && row.severity === "fatal").map((row) => row.id);
  return report(recoverErrors(ids.length > 0 ? ids : null));
}

/** Raises what is not fitted: the device can report it, and the history says that hardware.json does not have it. */
export function raiseAnyway(wanted: readonly GenerateOne[]): Promise<boolean> {
  const ids = [...new Set(wanted.map(({ id }) => id))];
  return report(send({ type: "generate", errors: [...wanted], again: false, anyway: true }), ids);
}

/** What is wanted, where all of it that is not fitted can be raised anyway. */
function absentOf(wanted: readonly GenerateOne[]): readonly GenerateOne[] {
  const { byId } = catalogueNow();
  const missing = wanted.filter((one) => !isFittedNow(one));
  return missing.length > 0 && missing.every(({ id }) => byId.get(id)?.absent) ? wanted : [];
}

async function report(
  answer: ReturnType<typeof send>,
  ids: readonly string[] = [],
  wanted: readonly GenerateOne[] = [],
): Promise<boolean> {
  set({ outcome: null, told: null });
  const { ok, message, near } = await answer;
  const raised = usePlc.getState().errors;
  const named = (near ?? []).map(idOf);
  const present = ok ? [] : named.filter((id) => ids.includes(id) && raised.get(id)?.status === "generated");
  const others = ok ? [] : (near ?? []).filter((name) => !present.includes(idOf(name)));
  const absent = ok ? [] : absentOf(wanted);
  set({
    outcome: { ok, message, ids, present, near: others, absent },
    told: { ids: ok ? ids : present, status: "generated" },
  });
  return ok;
}

// What was ticked and is not fitted any more would be raised although nothing shows it as ticked.
usePlc.subscribe((now, before) => {
  if (now.instances === before.instances) return;
  const { checked } = get();
  const left = [...checked].filter((key) => isThere(now, key) || !isThere(before, key));
  if (left.length < checked.size) set({ checked: new Set(left) });
});

const isThere = (
  { instances, errors }: Pick<ReturnType<typeof usePlc.getState>, "instances" | "errors">,
  key: string,
) => {
  const row = instances.get(key) ?? errors.get(key);
  return row !== undefined && row.fitted !== false;
};

// A message is shown as long as it is true: somebody else may have raised or recovered the errors since.
usePlc.subscribe((now, before) => {
  const { told } = get();
  if (!told || now.errors === before.errors) return;
  const undone = told.ids.some((id) => {
    const status = (now.instances.get(id) ?? now.errors.get(id))?.status;
    return status !== (before.instances.get(id) ?? before.errors.get(id))?.status && status !== told.status;
  });
  if (undone) set({ outcome: null, told: null });
});
