/** Error sweeps of the project, and the kept states from which they begin. */

import { create } from "zustand";
import { merged, olderFirst, withAccepted } from "../../logic/errors/sweep";
import { messageOf } from "../../logic/format/messageOf";
import { clockTime } from "../../logic/format/numbers";
import { copyName } from "../../logic/plc/instances";
import { t } from "../../text";
import { rest } from "../../wire/rest";
import type {
  CellRef,
  NewSweep,
  ProgramState,
  Reaction,
  Sweep,
  SweepComparison,
  SweepProgress,
  SweepSummary,
} from "../../wire/types";
import { keep, recall } from "../page/localStorage";
import { openPage, showPanel } from "../page/navigate";
import { refreshApp, useBench } from "../plc/bench";
import { openInstance } from "../plc/instances";
import { usePlc } from "../plc/plc";

/** What the page shows: the list, one sweep, or two of them side by side. */
type Shown = { view: "list" } | { view: "sweep"; id: number } | { view: "compare"; before: number; after: number };

/** The dialog that is open. */
type Question = { ask: "run" } | { ask: "keep"; scan: number | null };

interface Sweeps {
  project: number | null;
  /** The newest first; null until the server has answered. */
  list: readonly SweepSummary[] | null;
  states: readonly ProgramState[];
  shown: Shown;
  sweep: Sweep | null;
  comparison: SweepComparison | null;
  /** The cell that each running sweep tries now. */
  now: Readonly<Record<number, string>>;
  question: Question | null;
  /** The last refusal, or why something cannot be shown, in the server's words. */
  trouble: string | null;
}

const LIST: Shown = { view: "list" };

const nothing: Sweeps = {
  project: null,
  list: null,
  states: [],
  shown: LIST,
  sweep: null,
  comparison: null,
  now: {},
  question: null,
  trouble: null,
};

export const useSweeps = create<Sweeps>(() => nothing);
const get = useSweeps.getState;
const set = useSweeps.setState;

/** The title of the page's tab. */
export function useSweepTitle(): string {
  return useSweeps(({ shown, list }) => {
    if (shown.view === "compare") return t("sweep.compare.tab");
    const sweep = shown.view === "sweep" ? list?.find(({ id }) => id === shown.id) : undefined;
    return sweep ? t("sweep.tab", { at: clockTime(sweep.at) }) : t("sweep.tab.list");
  });
}

// ---- dialogs and pages -----------------------------------------------------------------------------------------

/** Opens the dialog "Run all": which errors, from which states. */
export function openSweep(): void {
  set({ question: { ask: "run" } });
  void refreshSweeps();
}

/** Asks for a name, and keeps the state of the PLC before `scan`; without a scan the state that is shown now. */
export function keepState(scan: number | null = shownScan()): void {
  set({ question: { ask: "keep", scan } });
}

export const closeQuestion = () => set({ question: null });

/** The shown scan while the page shows the past; null is now. */
export function shownScan(): number | null {
  const { state } = usePlc.getState();
  return state?.past ? state.scan : null;
}

export function showSweeps(): void {
  show(LIST);
}

export function showSweep(id: number): void {
  show({ view: "sweep", id });
}

export function compareSweeps(one: number, other: number): void {
  const [before, after] = olderFirst(get().list ?? [], one, other);
  show({ view: "compare", before, after });
}

function show(shown: Shown): void {
  set({ shown, trouble: null });
  const { project } = get();
  if (project !== null) keep(`sweep.${project}`, shown.view === "sweep" ? shown.id : null);
  openPage("sweep");
  // The list may have changed: the server does not report deletions by others.
  void (shown.view === "list" ? refreshSweeps() : loadShown());
}

// ---- what the server tells -------------------------------------------------------------------------------------

/** Fetches everything about the project's sweeps: when the page is shown first, and after the connection was lost. */
export async function refreshSweeps(): Promise<void> {
  const project = useBench.getState().project?.id ?? null;
  if (project !== get().project) {
    const id = project === null ? null : recall<number | null>(`sweep.${project}`, null);
    set({ ...nothing, question: get().question, project, shown: id === null ? LIST : { view: "sweep", id } });
  }
  if (project === null) return;
  await guarded(async () => {
    const [list, states] = await Promise.all([rest.sweeps(project), rest.states(project)]);
    if (get().project !== project) return;
    const { shown } = get();
    // The shown sweep was deleted by somebody meanwhile: the page shows the list instead.
    const gone = shown.view === "sweep" && !list.some(({ id }) => id === shown.id);
    set({ list, states, ...(gone ? { shown: LIST, sweep: null } : {}) });
    await loadShown();
  });
}

async function loadShown(): Promise<void> {
  const { shown } = get();
  if (shown.view === "list") return;
  if (shown.view === "sweep" && get().sweep?.id !== shown.id) set({ sweep: null });
  if (shown.view === "compare") set({ comparison: null });
  await guarded(async () => {
    if (shown.view === "sweep") {
      const sweep = await rest.sweep(shown.id);
      if (get().shown === shown) takeWhole(sweep);
    } else {
      const comparison = await rest.compareSweeps(shown.before, shown.after);
      if (get().shown === shown) set({ comparison });
    }
  });
}

/** Cells may have come by the socket while the whole sweep was being fetched. */
function takeWhole(sweep: Sweep): void {
  const known = get().sweep;
  set({ sweep: known?.id === sweep.id ? merged(sweep, known.done > sweep.done ? known : sweep, known.cells) : sweep });
}

/** After a reconnection: fetches what the socket missed. */
export function onSweepHello(): void {
  void refreshSweeps();
}

/** A sweep of this project began, continued or ended. */
export function onSweep({ sweep, now, cells }: SweepProgress): void {
  if (get().project !== sweep.project) return;
  const known = get().sweep;
  const grown = known?.id === sweep.id && known.total !== sweep.total; // details that the program tells apart have rows of their own
  noteSummary(sweep);
  set((state) => ({
    now: { ...state.now, [sweep.id]: now },
    sweep: state.sweep?.id === sweep.id ? merged(state.sweep, sweep, cells) : state.sweep,
  }));
  if (grown) void loadShown();
}

function noteSummary(summary: SweepSummary): void {
  set(({ list }) => {
    if (list === null) return {};
    const known = list.some(({ id }) => id === summary.id);
    return { list: known ? list.map((row) => (row.id === summary.id ? summary : row)) : [summary, ...list] };
  });
  set(({ sweep }) => (sweep?.id === summary.id ? { sweep: merged(sweep, summary, []) } : {}));
}

/** Performs an action; a refusal is shown on the page. */
async function guarded(deed: () => Promise<void>): Promise<void> {
  try {
    set({ trouble: null });
    await deed();
  } catch (error) {
    set({ trouble: messageOf(error) });
  }
}

// ---- actions ---------------------------------------------------------------------------------------------------

/** Begins a sweep and shows it. Throws the server's refusal, so that the dialog can show it. */
export async function beginSweep(wanted: NewSweep): Promise<void> {
  const { instance } = useBench.getState();
  if (!instance) throw new Error(t("sweep.noplc"));
  const made = await rest.beginSweep(instance.id, wanted);
  if (!get().list?.some(({ id }) => id === made.id)) noteSummary(made); // the socket may have told more already
  set({ question: null });
  showSweep(made.id);
}

/** Throws the server's refusal. */
export async function keepStateAs(name: string, scan: number | null): Promise<ProgramState> {
  const { instance } = useBench.getState();
  if (!instance) throw new Error(t("sweep.noplc"));
  const made = await rest.keepState(instance.id, name, scan);
  set(({ states }) => ({ states: [...states, made].sort((a, b) => (a.name < b.name ? -1 : 1)) })); // as the server lists them
  return made;
}

export async function deleteState({ id }: ProgramState): Promise<void> {
  await rest.deleteState(id);
  set(({ states }) => ({ states: states.filter((known) => known.id !== id) }));
}

// What becomes of it is told over the socket.
export const cancelSweep = (id: number) => guarded(async () => void (await rest.cancelSweep(id)));
export const resumeSweep = (id: number) => guarded(async () => void (await rest.resumeSweep(id)));

export async function deleteSweep(id: number): Promise<void> {
  await rest.deleteSweep(id);
  const { list, shown } = get();
  set({ list: list?.filter((known) => known.id !== id) ?? null });
  if (shown.view === "sweep" && shown.id === id) show(LIST);
}

/** The complete result of one cell. */
export const reactionOf = (id: number, cell: CellRef): Promise<Reaction> => rest.sweepReaction(id, cell);

/** Throws the server's refusal. */
export async function acceptFinding(id: number, cell: CellRef, reason: string): Promise<void> {
  const accepted = await rest.acceptFinding(id, cell, reason);
  set(({ sweep }) => ({ sweep: sweep?.id === id ? withAccepted(sweep, cell, accepted) : sweep }));
}

export const withdrawFinding = (id: number, cell: CellRef) =>
  guarded(async () => {
    await rest.withdrawFinding(id, cell);
    set(({ sweep }) => ({ sweep: sweep?.id === id ? withAccepted(sweep, cell, null) : sweep }));
  });

/** Makes a new PLC with the state and the error of a cell, paused, and shows it. */
export const openCell = (id: number, cell: CellRef) =>
  guarded(async () => {
    const taken = (useBench.getState().app?.instances ?? []).map(({ name }) => name);
    const name = t("sweep.open.name", cell).slice(0, 90);
    const made = await rest.openCell(id, cell, taken.includes(name) ? copyName(name, taken) : name);
    await refreshApp();
    openInstance(made);
    showPanel("errors");
  });
