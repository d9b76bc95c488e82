/** What is chosen in the error simulator, and its three commands. */
import { create } from "zustand";
import { allErrors, defaultDetails, type ErrorStatus, toggleAll } from "../logic/catalogue";
import { send } from "../wire/send";
import type { ErrorInfo, ModelInfo } from "../wire/types";
import { usePlc } from "./plc";

export interface Outcome {
  ok: boolean;
  message: string;
}

interface Simulator {
  filter: string;
  status: ErrorStatus | "all";
  closed: ReadonlySet<string>;
  checked: ReadonlySet<string>;
  selected: string | null;
  /** Details as edited, by error; the others stand at their defaults. */
  details: Readonly<Record<string, Record<string, string>>>;
  outcome: Outcome | null;
}

const nothing: Simulator = {
  filter: "",
  status: "all",
  closed: new Set(),
  checked: new Set(),
  selected: null,
  details: {},
  outcome: null,
};

export const useSimulator = create<Simulator>(() => nothing);
const get = useSimulator.getState;
const set = useSimulator.setState;

export function resetSimulator(): void {
  set(nothing);
}

export const setFilter = (filter: string) => set({ filter });
export const setStatusFilter = (status: ErrorStatus | "all") => set({ status });
export const selectError = (selected: string | null) => set({ selected, outcome: null });

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

export function setDetail(error: ErrorInfo, name: string, value: string): void {
  set(({ details }) => ({
    details: { ...details, [error.id]: { ...(details[error.id] ?? defaultDetails(error)), [name]: value } },
  }));
}

/** What the buttons work on: what is ticked, else the selected error; the key of a group begins with a slash. */
export function targets(state: Pick<Simulator, "checked" | "selected">): string[] {
  if (state.checked.size > 0) return [...state.checked];
  return state.selected === null || state.selected.startsWith("/") ? [] : [state.selected];
}

export async function generate(model: ModelInfo): Promise<void> {
  const state = get();
  const wanted = new Set(targets(state));
  const errors = allErrors(model.catalogue)
    .filter((error) => wanted.has(error.id))
    .map((error) => ({ id: error.id, details: state.details[error.id] ?? defaultDetails(error) }));
  if (errors.length === 0) return;
  await report(send({ type: "generate", errors }));
}

/** Recovers those of the chosen errors that are generated; `everything` recovers all there are. */
export async function recover(everything: boolean): Promise<void> {
  const { errors } = usePlc.getState();
  const ids = everything ? null : targets(get()).filter((id) => errors.get(id)?.status === "generated");
  await report(send({ type: "recover", ids }));
}

/** The way out of a fatal stop: recovers the fatal errors, the others stay. */
export async function clearFatal(): Promise<void> {
  const rows = [...usePlc.getState().errors.values()];
  const ids = rows.filter((row) => row.status === "generated" && row.severity === "fatal").map((row) => row.id);
  await report(send({ type: "recover", ids: ids.length > 0 ? ids : null }));
}

async function report(answer: ReturnType<typeof send>): Promise<void> {
  set({ outcome: null });
  const { ok, message } = await answer;
  set({ outcome: { ok, message } });
}
