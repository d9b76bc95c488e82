/** What is chosen in the error simulator, what is typed there, and its commands. */

import { create } from "zustand";
import { type ErrorStatus, type ReactionFilter, toggleAll } from "../../logic/errors/catalogue";
import {
  defaultEntries,
  type Entries,
  type Entry,
  entriesIn,
  needsDetails,
  wireDetails,
} from "../../logic/errors/details";
import { isPlain, plainShape, readShape, type ShapeForm } from "../../logic/errors/shapes";
import { withName } from "../../logic/plc/expression";
import { send } from "../../wire/send";
import type { ErrorHistoryRow, ErrorInfo, GenerateOne } from "../../wire/types";
import { readClock } from "../plc/clock";
import { usePlc } from "../plc/plc";
import { onInstanceChange } from "../plc/reset";

export interface Outcome {
  ok: boolean;
  message: string;
  /** What it was about. */
  ids: readonly string[];
  /** Of these, the ones that are generated already: generating them again changes their details. */
  present: readonly string[];
  /** Names that come near one that the PLC did not know. */
  near: readonly string[];
}

interface Simulator {
  filter: string;
  status: ErrorStatus | "all";
  severity: ErrorInfo["severity"] | "all";
  reaction: ReactionFilter;
  closed: ReadonlySet<string>;
  checked: ReadonlySet<string>;
  selected: string | null;
  /** Details as edited, by error; the others stand at their defaults. */
  details: Readonly<Record<string, Entries>>;
  /** When the next fault begins and how it goes on. */
  shape: ShapeForm;
  /** The dialog for several errors is open, with these. */
  asking: readonly string[] | null;
  outcome: Outcome | null;
  /** What the outcome says became of which errors, or why it was refused: they are present. */
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
export const selectError = (selected: string | null) => set({ selected, outcome: null });
export const setShape = (change: Partial<ShapeForm>) => set(({ shape }) => ({ shape: { ...shape, ...change } }));
export const closeDialog = () => set({ asking: null });
export const forgetOutcome = () => set({ outcome: null });

/** A name in the condition that the PLC did not know becomes one that it does. */
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

/** Details as edited; else those with which the error is present, else its defaults. */
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

/** What the buttons work on: what is ticked, else the selected error; the key of a group begins with a slash. */
export function targets(state: Pick<Simulator, "checked" | "selected">): string[] {
  if (state.checked.size > 0) return [...state.checked];
  return state.selected === null || state.selected.startsWith("/") ? [] : [state.selected];
}

/** Several errors are asked for in a dialog; those of one stand in place, unless another error is shown there. */
export function asksFirst(state: Pick<Simulator, "checked" | "selected">, errors: readonly ErrorInfo[]): boolean {
  const chosen = chosenOf(state, errors);
  if (chosen.length === 1 && chosen[0]?.id === state.selected) return false;
  return chosen.some(needsDetails);
}

/** The errors that the buttons work on, in the order of the catalogue. */
export function chosenOf(state: Pick<Simulator, "checked" | "selected">, errors: readonly ErrorInfo[]): ErrorInfo[] {
  const wanted = new Set(targets(state));
  return errors.filter((error) => wanted.has(error.id));
}

/** Opens the dialog for what is chosen, whether it needs details or not. */
export function askDetails(errors: readonly ErrorInfo[]): void {
  const chosen = chosenOf(get(), errors);
  if (chosen.length > 0) set({ asking: chosen.map((error) => error.id), outcome: null });
}

/** Raises what is chosen; asks for the details first where several need some. */
export async function generate(errors: readonly ErrorInfo[]): Promise<void> {
  if (asksFirst(get(), errors)) askDetails(errors);
  else await raise(chosenOf(get(), errors));
}

export const asWanted = (errors: readonly ErrorInfo[]): GenerateOne[] =>
  errors.map((error) => ({ id: error.id, details: wireDetails(error, entriesNow(error)) }));

/** Raises these in one seam, or arms them when they come later, one by one or not to stay. True when it was accepted. */
export async function raise(errors: readonly ErrorInfo[], { gap = 0, again = false } = {}): Promise<boolean> {
  if (errors.length === 0) return false;
  const { shape: form } = get();
  const wanted = asWanted(errors);
  if (again || (isPlain(form) && gap === 0)) return report(send({ type: "generate", errors: wanted, again }), errors);
  const { start, shape, troubles } = readShape(form, readClock().scan);
  if (Object.keys(troubles).length > 0) return false;
  const accepted = await report(send({ type: "arm", errors: wanted, start, shape, gap }), errors);
  // The next error is an ordinary one again, unless somebody says otherwise.
  if (accepted) set(({ shape: now }) => ({ shape: { ...now, when: "now", how: "stay" } }));
  return accepted;
}

/** What was refused because some of it is present, once more: what is present takes the details that are shown now. */
export async function changeDetails(errors: readonly ErrorInfo[], outcome: Outcome): Promise<boolean> {
  const ids = new Set(outcome.ids);
  return raise(
    errors.filter((error) => ids.has(error.id)),
    { again: true },
  );
}

/** Recovers those of the chosen errors that are generated; `everything` recovers all there are. */
export async function recover(everything: boolean): Promise<void> {
  const { errors } = usePlc.getState();
  const present = [...errors.values()].filter((row) => row.status === "generated").map((row) => row.id);
  const ids = everything ? present : targets(get()).filter((id) => present.includes(id));
  if (await report(send({ type: "recover", ids: everything ? null : ids }))) set({ told: { ids, status: "cleared" } });
}

/** Takes faults back; null is all of them. */
export async function disarm(ids: number[] | null): Promise<void> {
  await report(send({ type: "disarm", ids }));
}

/** The way out of a fatal stop: recovers the fatal errors, the others stay. True when it was done. */
export async function clearFatal(): Promise<boolean> {
  const rows = [...usePlc.getState().errors.values()];
  const ids = rows.filter((row) => row.status === "generated" && row.severity === "fatal").map((row) => row.id);
  return report(send({ type: "recover", ids: ids.length > 0 ? ids : null }));
}

async function report(answer: ReturnType<typeof send>, errors: readonly ErrorInfo[] = []): Promise<boolean> {
  set({ outcome: null, told: null });
  const { ok, message, near } = await answer;
  const ids = errors.map((error) => error.id);
  const raised = usePlc.getState().errors;
  const present = ok ? [] : (near ?? []).filter((id) => ids.includes(id) && raised.get(id)?.status === "generated");
  const others = ok ? [] : (near ?? []).filter((name) => !present.includes(name));
  set({ outcome: { ok, message, ids, present, near: others }, told: { ids: ok ? ids : present, status: "generated" } });
  return ok;
}

// What was done is said as long as it is so: somebody else may have raised or recovered it since.
usePlc.subscribe((now, before) => {
  const { told } = get();
  if (!told || now.errors === before.errors) return;
  const undone = told.ids.some((id) => {
    const status = now.errors.get(id)?.status;
    return status !== before.errors.get(id)?.status && status !== told.status;
  });
  if (undone) set({ outcome: null, told: null });
});
