/** Traces of the PLC: which exist, which one is shown, its visible part, and its cursors. */

import { create } from "zustand";
import { messageOf } from "../../logic/format/messageOf";
import { within } from "../../logic/trace/plots";
import type { Range, Samples } from "../../logic/trace/samples";
import { t } from "../../text";
import { Refused } from "../../wire/rest";
import { type Source, traces as wire } from "../../wire/traces";
import type {
  ChangeTrace,
  Retrospective,
  TraceDefinition,
  TraceInfo,
  TraceRecordInfo,
  TraceSignal,
} from "../../wire/types";
import { saveFile } from "../page/download";
import { keep, recall } from "../page/localStorage";
import { useBench } from "../plc/bench";
import { onInstanceChange } from "../plc/reset";

export type Cursor = "a" | "b";

export interface Compared {
  record: TraceRecordInfo;
  samples: Samples;
  /** The number of scans by which it is shifted. */
  shift: number;
  by: "trigger" | "first";
}

interface Traces {
  traces: readonly TraceInfo[];
  records: readonly TraceRecordInfo[];
  source: Source | null;
  /** The visible part; null is all. */
  view: Range | null;
  /** The view moves along with the newest sample. */
  follows: boolean;
  a: number | null;
  b: number | null;
  compared: Compared | null;
  retrospectives: readonly Retrospective[];
  /** Signals that were dragged to a different plot: text -> key of the plot. */
  moved: ReadonlyMap<string, string>;
  trouble: { message: string; near: readonly string[]; add?: string } | null;
}

const nothing: Traces = {
  traces: [],
  records: [],
  source: null,
  view: null,
  follows: true,
  a: null,
  b: null,
  compared: null,
  retrospectives: [],
  moved: new Map(),
  trouble: null,
};

export const useTraces = create<Traces>(() => nothing);
const get = useTraces.getState;
const set = useTraces.setState;

/** The initial width, in scans, of a view that follows. */
const FOLLOWED = 1000;

/** The shown trace, or the shown record of a trace. */
export interface Shown {
  source: Source;
  name: string;
  signals: readonly TraceSignal[];
  every: number;
  triggered: number | null;
  first: number;
  end: number;
  interval: number;
  generation: number;
  trace: TraceInfo | null;
  record: TraceRecordInfo | null;
}

export function shownOf({ source, traces, records }: Pick<Traces, "source" | "traces" | "records">): Shown | null {
  if (source === null) return null;
  const trace = source.kind === "trace" ? (traces.find(({ id }) => id === source.id) ?? null) : null;
  const record = source.kind === "record" ? (records.find(({ id }) => id === source.id) ?? null) : null;
  const about = trace ?? record;
  if (!about) return null;
  const { signals, triggered, first, end, interval_ns: interval } = about;
  return {
    source,
    name: trace?.definition.name ?? record?.name ?? "",
    signals,
    every: trace?.definition.every ?? record?.every ?? 1,
    triggered,
    first,
    end,
    interval,
    generation: trace?.generation ?? 1,
    trace,
    record,
  };
}

export const isRecording = (trace: TraceInfo | null): boolean =>
  trace !== null && ["recording", "armed", "triggered"].includes(trace.state);

const instanceId = () => useBench.getState().instance?.id ?? null;

// ---- messages of the server --------------------------------------------------------------------------------------

onInstanceChange(() => set({ ...nothing, moved: new Map(recall<[string, string][]>("trace.moved", [])) }));

/** When the panel is shown first and after a lost connection. */
export async function refreshTraces(): Promise<void> {
  const { instance, project } = useBench.getState();
  if (!instance || !project) return;
  try {
    const [traces, records] = await Promise.all([wire.all(instance.id), wire.records(project.id)]);
    if (instanceId() !== instance.id) return;
    set({ records });
    onTraces(traces);
  } catch (error) {
    fail(error);
  }
}

export function onTraces(traces: readonly TraceInfo[]): void {
  const { source, records } = get();
  const before = shownOf(get());
  const gone = source === null || (source.kind === "trace" && !traces.some(({ id }) => id === source.id));
  const first = traces[0];
  set({ traces, source: gone ? (first ? { kind: "trace", id: first.id } : null) : source, records });
  const now = shownOf(get());
  if (
    now &&
    before &&
    now.source.id === before.source.id &&
    now.generation !== before.generation &&
    !goesOn(before, now)
  )
    rewind(now);
  else if (now && !before) rewind(now);
}

/** The signals of the same record changed: the view stays. */
function goesOn(before: Shown, now: Shown): boolean {
  const texts = (shown: Shown) => shown.signals.map(({ text }) => text).join("\n");
  return texts(now) !== texts(before) && now.first < Math.min(before.end, now.end);
}

/** A different record is shown: a live one is followed, a complete one is shown as a whole. */
function rewind(now: Shown): void {
  const follows = isRecording(now.trace) && now.trace?.definition.trigger === null;
  set({ view: null, follows, a: null, b: null });
}

export function onRetrospective(retrospective: Retrospective): void {
  const over = retrospective.record !== null || retrospective.message !== "";
  set(({ retrospectives }) => {
    const others = retrospectives.filter(({ id }) => id !== retrospective.id);
    return { retrospectives: over ? others : [...others, retrospective] };
  });
  if (retrospective.record !== null) void showRecord(retrospective.record);
  else if (retrospective.message) set({ trouble: { message: retrospective.message, near: [] } });
}

async function showRecord(id: number): Promise<void> {
  const project = useBench.getState().project;
  if (!project) return;
  set({ records: await wire.records(project.id) });
  choose({ kind: "record", id });
}

// ---- actions ------------------------------------------------------------------------------------------------------

function fail(error: unknown, add?: string): void {
  const near = error instanceof Refused ? (error.refusal.near ?? []) : [];
  set({ trouble: { message: messageOf(error), near, ...(add === undefined ? {} : { add }) } });
}

export const putAwayTrouble = () => set({ trouble: null });

export function choose(source: Source): void {
  set({ source, compared: null, trouble: null });
  const now = shownOf(get());
  if (now) rewind(now);
}

const PLAIN: Omit<TraceDefinition, "name" | "signals"> = {
  every: 1,
  scans: 30_000,
  trigger: null,
  repeat: false,
};

/** Shows the trace that `ask` makes or changes. What it is then comes over the socket, which may have told more already than the
 * answer says. `add`: the signal that is tried again if it is refused. */
async function define(ask: (instance: number) => Promise<TraceInfo>, add?: string): Promise<boolean> {
  const instance = instanceId();
  if (instance === null) return false;
  const before = get().source;
  try {
    const made = await ask(instance);
    set(({ traces }) => ({
      traces: traces.some(({ id }) => id === made.id) ? traces : [...traces, made],
      source: { kind: "trace", id: made.id },
      compared: null,
      trouble: null,
    }));
    const now = shownOf(get());
    if (now && !(before?.kind === "trace" && before.id === made.id)) rewind(now);
    return true;
  } catch (error) {
    fail(error, add);
    return false;
  }
}

function freshName(): string {
  const names = new Set(get().traces.map(({ definition }) => definition.name));
  for (let number = 1; ; number += 1) {
    const name = t("trace.name", { number });
    if (!names.has(name)) return name;
  }
}

/** Makes a new trace of these signals; recording begins now. */
export function newTrace(signals: readonly string[], name = freshName()): Promise<boolean> {
  const wanted = { ...PLAIN, name, signals: [...signals], start: true };
  return define((instance) => wire.make(instance, wanted), signals[0]);
}

/** Adds paths to the shown trace, or to a new first one. */
export async function addAllToTrace(paths: readonly string[]): Promise<boolean> {
  const shown = shownOf(get());
  const trace = shown?.trace ?? null;
  if (trace === null) return newTrace([...new Set(paths)]);
  const fresh = [...new Set(paths)].filter((path) => !trace.definition.signals.includes(path));
  if (fresh.length === 0) return true;
  return change({ add: fresh }, fresh[0]);
}

export function removeSignal(text: string): void {
  const trace = shownOf(get())?.trace;
  if (!trace) return;
  if (trace.definition.signals.every((signal) => signal === text)) void deleteShown();
  else void change({ remove: [text] });
}

/** Changes the definition of the shown trace: only what is said, so that a change that is still under way is not taken back. */
export async function change(part: Partial<ChangeTrace>, add?: string): Promise<boolean> {
  const trace = shownOf(get())?.trace;
  if (!trace) return false;
  // A different name or different signals keep the recorded samples, and a recording trace continues.
  const keeps = Object.keys(part).every((key) => ["name", "add", "remove"].includes(key));
  const by: ChangeTrace = { add: [], remove: [], ...part, start: !keeps };
  return define((instance) => wire.change(instance, trace.id, by), add);
}

export async function drive(action: "start" | "stop"): Promise<void> {
  const instance = instanceId();
  const trace = shownOf(get())?.trace;
  if (instance === null || !trace) return;
  try {
    await wire.drive(instance, trace.id, action);
    set({ trouble: null });
  } catch (error) {
    fail(error);
  }
}

export async function deleteShown(): Promise<void> {
  const instance = instanceId();
  const shown = shownOf(get());
  if (instance === null || !shown) return;
  try {
    if (shown.record) {
      await wire.deleteRecord(shown.record.id);
      const records = get().records.filter(({ id }) => id !== shown.record?.id);
      set({ records, source: null });
      onTraces(get().traces);
    } else {
      await wire.delete(instance, shown.source.id);
      onTraces(get().traces.filter(({ id }) => id !== shown.source.id));
    }
  } catch (error) {
    fail(error);
  }
}

/** Keeps the recorded samples in the project. Throws the refusal. */
export async function keepShown(name: string): Promise<void> {
  const instance = instanceId();
  const shown = shownOf(get());
  if (instance === null || !shown?.trace) return;
  const record = await wire.keep(instance, shown.trace.id, name);
  set(({ records }) => ({ records: [record, ...records] }));
}

/** Draws a kept record beside the shown one: aligned by their triggers if both have one, else by their first scans. */
export async function compare(record: TraceRecordInfo | null, samples: Samples | null): Promise<void> {
  const shown = shownOf(get());
  if (!record || !samples || !shown) {
    set({ compared: null });
    return;
  }
  const byTrigger = record.triggered !== null && shown.triggered !== null;
  const shift = byTrigger ? (shown.triggered ?? 0) - (record.triggered ?? 0) : shown.first - record.first;
  set({ compared: { record, samples, shift, by: byTrigger ? "trigger" : "first" } });
}

/** Makes a retrospective trace of the last scans; how far it is comes over the socket. */
export async function recordEarlier(signals: readonly string[], scans: number, every: number): Promise<void> {
  const instance = instanceId();
  if (instance === null) return;
  await wire.recordEarlier(instance, signals, scans, every);
  set({ trouble: null });
}

export async function cancelRetrospective(id: number): Promise<void> {
  await wire.cancelRetrospective(id).catch(fail);
}

export async function exportCsv(): Promise<void> {
  const instance = instanceId();
  const shown = shownOf(get());
  if (instance === null || !shown) return;
  try {
    saveFile(await wire.csv(instance, shown.source), `${shown.name}.csv`);
  } catch (error) {
    fail(error);
  }
}

export function moveTo(text: string, plot: string): void {
  set(({ moved }) => ({ moved: new Map(moved).set(text, plot) }));
  keep("trace.moved", [...get().moved]);
}

// ---- the view -----------------------------------------------------------------------------------------------------

/** The existing scans; a record that has just begun gets some extra room. */
export function wholeOf({ first, end, every }: Shown): Range {
  return { from: first, to: Math.max(end - 1, first + 10 * every) };
}

/** The part to show now. */
export function viewOf({ view, follows }: Pick<Traces, "view" | "follows">, shown: Shown, end = shown.end): Range {
  const whole = wholeOf({ ...shown, end: Math.max(end, shown.end) });
  if (!follows) return view ?? whole;
  const width = view === null ? FOLLOWED * shown.every : view.to - view.from;
  return { from: whole.to - width, to: whole.to };
}

/** Shows a part; one that ends at the newest sample of a recording trace moves along. */
export function look(view: Range | null): void {
  const shown = shownOf(get());
  if (!shown) return;
  const whole = wholeOf(shown);
  if (view === null) {
    set({ view: null, follows: false });
    return;
  }
  const part = within(view, whole);
  const follows = isRecording(shown.trace) && part.to >= whole.to - (part.to - part.from) * 0.01;
  set({ view: part, follows });
}

export function follow(): void {
  const shown = shownOf(get());
  if (shown) set({ view: get().view, follows: true });
}

export function setCursor(cursor: Cursor, scan: number | null): void {
  set(cursor === "a" ? { a: scan } : { b: scan });
}

/** Samples of the view, fetched directly from the server. */
export async function readSamples(
  source: Source,
  first: number,
  last: number | null,
  points: number | null,
): Promise<ArrayBuffer | null> {
  const instance = instanceId();
  if (instance === null) return null;
  try {
    return await wire.samples(instance, source, Math.max(0, Math.floor(first)), last, points);
  } catch {
    return null; // the next turn tries again; the lost connection is reported elsewhere
  }
}
