/** The run from its first scan to the live one, and going back in it. */

import { create } from "zustand";
import { messageOf } from "../../logic/format/messageOf";
import { type Axis, including } from "../../logic/plc/timeline";
import { t } from "../../text";
import { blob } from "../../wire/rest";
import { send } from "../../wire/send";
import type { Mark, Timeline, TimelineInfo } from "../../wire/types";
import { saveFile } from "../page/download";
import { useBench } from "./bench";
import { readClock } from "./clock";
import { usePlc } from "./plc";
import { onInstanceChange } from "./reset";

const MARK_LIMIT = 5000;

interface Moment {
  scan: number;
  /** Inside of the scan, before its statement of this count. */
  count: number;
}

interface Run {
  info: TimelineInfo | null;
  marks: readonly Mark[];
  /** The visible part of the run; null is all of it. */
  view: Axis | null;
  /** The view moves along with the live end. */
  follows: boolean;
  /** The scan that the page is going to, until the PLC is there. */
  aim: number | null;
  refused: string | null;
  /** Name of the test that was just made of the run, and downloaded. */
  made: { name: string; expects: boolean } | null;
  /** Where somebody wants to go who would take others along: they choose first. */
  asking: Moment | null;
  /** The scans that are selected, both included; null while none are. */
  selection: Axis | null;
  /** The damage report that was dismissed. */
  read: string;
}

const nothing: Run = {
  info: null,
  marks: [],
  view: null,
  follows: true,
  aim: null,
  refused: null,
  made: null,
  asking: null,
  selection: null,
  read: "",
};

export const useTimeline = create<Run>(() => nothing);
const get = useTimeline.getState;
const set = useTimeline.setState;

onInstanceChange(() => set(nothing));

export function onTimeline({ info, marks, fresh }: Timeline): void {
  set((run) => ({ info, marks: fresh ? marks : [...run.marks, ...marks].slice(-MARK_LIMIT) }));
}

/** Shows a part of the run, or all of it with null. A view that ends at the live scan moves along with it. */
export function setView(view: Axis | null, whole: Axis): void {
  set({ view, follows: view === null || view.to >= whole.to });
}

/** A view that does not follow the live end is moved so that it contains the target. */
function inSight(scan: number | null): Partial<Run> {
  const { view, follows, info } = get();
  if (view === null || follows) return {};
  if (scan === null) return { follows: true };
  return { view: including(view, { from: info?.first_scan ?? 0, to: liveScan() }, scan) };
}

/** Selects a stretch of the run, both scans included, in either order; null clears the selection. */
export function selectStretch(one: number | null, other = one): void {
  if (one === null || other === null) set({ selection: null });
  else set({ selection: { from: Math.min(one, other), to: Math.max(one, other) } });
}

export const putAwayDamage = () => set(({ info }) => ({ read: info?.damage ?? "" }));

/** The newest scan, whatever the page shows. */
export function liveScan(): number {
  return usePlc.getState().state?.past?.live_scan ?? readClock().scan;
}

let underWay = false;
let next: { scan: number | null; count: number } | null = null;

/** Shows the PLC as it was before a scan, or before its statement of this `count`; null returns to live. While one
 * request is running, only the last further request is kept. Before it takes others along from the live PLC, it asks. */
export async function travel(scan: number | null, count = 0, everybody = false): Promise<void> {
  set({ aim: scan ?? liveScan(), ...inSight(scan), asking: null });
  if (scan !== null && !everybody && takesOthersAlong()) {
    set({ asking: { scan, count } });
    return;
  }
  next = { scan, count };
  if (underWay) return;
  underWay = true;
  let last: number | null = scan;
  while (next !== null) {
    const wish: { scan: number | null; count: number } = next;
    next = null;
    last = wish.scan;
    const answer = await send({ type: "travel", ...wish });
    set({ refused: answer.ok ? null : answer.message });
  }
  underWay = false;
  arrive(last);
}

function takesOthersAlong(): boolean {
  const { state, users, you } = usePlc.getState();
  return !state?.past && users.some(({ name }) => name !== you?.name);
}

/** The question is answered: goes there with everybody, or stays. */
export function answerTravel(go: boolean): void {
  const { asking } = get();
  if (go && asking) void travel(asking.scan, asking.count, true);
  else set({ asking: null, aim: null });
}

/** The playhead stays at the target until the state confirms it: the answer may arrive before the state. */
function arrive(scan: number | null): void {
  const { state } = usePlc.getState();
  const shown = state?.past ? state.scan : null;
  if (get().refused !== null || shown === scan) set({ aim: null });
  else {
    const stop = usePlc.subscribe((plc, before) => {
      if (plc.state === before.state) return;
      stop();
      if (!underWay) set({ aim: null });
    });
  }
}

/** Goes one scan back: into the past, or further into it. */
export function stepBack(): void {
  const first = useTimeline.getState().info?.first_scan ?? 0;
  const { scan } = readClock();
  if (scan > first) void travel(scan - 1);
}

/** Goes one scan forward in the past; at its end the page returns to live. */
export function stepForward(): void {
  const { scan } = readClock();
  void travel(scan + 1 >= liveScan() ? null : scan + 1);
}

/** Shift+Esc, and the button of the banner. */
export function returnToLive(): void {
  if (usePlc.getState().state?.past) void travel(null);
}

/** A test of what people did so far, or before the scan of the past that is shown. */
export const saveScenarioNow = () => void saveScenario(usePlc.getState().state?.past ? readClock().scan : null);

const TOLD_MS = 15_000;

/** Saves the file of a scenario: what people did before a scan, or so far, as a test. */
export async function saveScenario(scan: number | null): Promise<void> {
  const { instance } = useBench.getState();
  if (instance === null) return;
  try {
    const text = await blob(`/instances/${instance.id}/scenario${scan === null ? "" : `?scan=${scan}`}`);
    const content = await text.text();
    const scans = /^scans: (\d+)/m.exec(content)?.[1] ?? "0";
    const made = {
      name: `${instance.name}-${scans}-scans.scenario.yaml`,
      expects: /^expect:/m.test(content),
    };
    saveFile(text, made.name);
    set({ refused: null, made });
    setTimeout(() => set((now) => (now.made === made ? { made: null } : {})), TOLD_MS);
  } catch (error) {
    set({ refused: t("scenario.failed", { message: messageOf(error) }) });
  }
}
