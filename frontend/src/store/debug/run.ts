/** Mode and run controls: the commands that they send, and the refusals. */
import { create } from "zustand";
import { forbidden } from "../../logic/plc/permits";
import { t } from "../../text";
import { type Answer, send } from "../../wire/send";
import type { Mode, RestartKind, RunOrder } from "../../wire/types";
import { keep, recall } from "../page/localStorage";
import { usePlc } from "../plc/plc";
import { stepForward, useTimeline } from "../plc/timeline";
import { useDocuments } from "../project/documents";
import { step, stepScan } from "./stepping";

export const SPEEDS = [0.01, 0.1, 0.5, 1, 2, 10, 100, 1000, 0] as const;
const CONDITIONS = 5;

interface RunState {
  refused: string | null;
  /** The conditions of earlier runs, the last one first. */
  conditions: readonly string[];
}

export const useRun = create<RunState>(() => ({ refused: null, conditions: recall<string[]>("conditions", []) }));

export function speedName(speed: number): string {
  return speed === 0 ? t("run.max") : `×${speed}`;
}

export async function runAction(action: RunOrder["action"]): Promise<void> {
  await order({ action });
}

/** Changes only the speed: a paused PLC stays paused, and a run with an end keeps its end. */
export async function setSpeed(speed: number): Promise<void> {
  await order({ action: "speed", speed });
}

/** Runs this many scans, then pauses. The dialog shows a refusal itself. */
export function runScans(scans: number): Promise<Answer> {
  return post({ action: "continue", scans });
}

/** Runs up to the first scan after which a condition holds. An accepted condition is stored, to be offered again. */
export async function runUntil(until: string): Promise<Answer> {
  const answer = await post({ action: "continue", until });
  if (!answer.ok) return answer;
  const conditions = [until, ...useRun.getState().conditions.filter((kept) => kept !== until)].slice(0, CONDITIONS);
  useRun.setState({ conditions });
  keep("conditions", conditions);
  return answer;
}

export async function restart(kind: RestartKind): Promise<void> {
  report(await send({ type: "restart", kind }));
}

export async function rollBack(): Promise<void> {
  if (report(await send({ type: "roll_back" })).ok) useDocuments.setState({ change: null });
}

/** Begins at scan 0, with an empty timeline. The dialog shows a refusal itself. */
export async function newRun(): Promise<void> {
  const answer = await send({ type: "new_run" });
  if (!answer.ok) throw new Error(answer.message || t("notsent"));
}

export async function chooseMode(mode: Mode): Promise<void> {
  report(await send({ type: "mode", mode }));
}

/** Leaves a run-time error without a restart: recovers the present errors, and the program continues in MONITOR. */
export async function recoverAndGoOn(): Promise<void> {
  const present = [...usePlc.getState().errors.values()].some((row) => row.status === "generated");
  if (present && !report(await send({ type: "recover", ids: null })).ok) return;
  await backTo("MONITOR");
}

/** The mode in which the program ran until it was stopped; MONITOR when this page has not seen it run. */
let ranIn: Mode = "MONITOR";

export function modeBefore(): Mode {
  const mode = usePlc.getState().state?.mode ?? "PROGRAM";
  return mode === "PROGRAM" ? ranIn : mode;
}

/** Sets the mode once no fatal error is present: at once where the model allows it, else by way of PROGRAM. */
export async function backTo(mode: Mode): Promise<void> {
  const direct = await send({ type: "mode", mode });
  // PROGRAM also ends a run-time error that no error of the catalogue reports.
  if (!direct.ok && report(await send({ type: "mode", mode: "PROGRAM" })).ok) await chooseMode(mode);
}

/** Runs to an earlier condition, from the menu: a refusal is shown in the status bar. */
export async function runUntilAgain(until: string): Promise<void> {
  report(await runUntil(until));
}

async function order(wanted: RunOrder): Promise<void> {
  report(await post(wanted));
}

function post({ action, speed = null, scans = null, until = null }: RunOrder): Promise<Answer> {
  return send({ type: "run", action, speed, scans, until });
}

function report(answer: Answer): Answer {
  useRun.setState({ refused: answer.ok ? null : answer.message || t("notsent") });
  return answer;
}

/** Removes the message of a refusal: a later command was accepted, or the state of the PLC changed. */
export function forgetRefusals(): void {
  if (useRun.getState().refused !== null) useRun.setState({ refused: null });
  if (useTimeline.getState().refused !== null) useTimeline.setState({ refused: null });
}

usePlc.subscribe(({ state: now }, { state: before }) => {
  if (now?.state === "running" || now?.state === "paused") ranIn = now.mode;
  if (now?.state !== before?.state || now?.mode !== before?.mode || now?.past?.live_scan !== before?.past?.live_scan)
    forgetRefusals();
});

/** F5: continues when paused or halted, pauses when running. */
export function toggleRun(): void {
  const { state } = usePlc.getState();
  if (state?.halt) void step("continue");
  if (state?.state === "running") void runAction("pause");
  if (state?.state === "paused") void runAction("continue");
}

/** F8: runs one scan, or in the past goes to the next one. */
export function singleScan(): void {
  const { state } = usePlc.getState();
  if (state?.state === "paused") void runAction("scan");
  else if (state?.halt) void stepScan();
  else if (state?.past) stepForward();
}

/** Ctrl+Shift+F5. */
export function restartByKey(): void {
  const { state, link } = usePlc.getState();
  if (forbidden(state, link.state === "open", "restart") === null) void restart("cold");
}
