/** Mode and run controls: what they send, and what was refused. */
import { create } from "zustand";
import { t } from "../logic/text";
import { send } from "../wire/send";
import type { Mode } from "../wire/types";
import { usePlc } from "./plc";

export const SPEEDS = [0.1, 1, 10, 100, 0] as const;

interface RunRefusal {
  refused: string | null;
}

export const useRun = create<RunRefusal>(() => ({ refused: null }));

export function speedName(speed: number): string {
  return speed === 0 ? t("run.max") : `×${speed}`;
}

type Action = "continue" | "pause" | "scan" | "restart";

export async function runAction(action: Action): Promise<void> {
  await order(action, null);
}

/** A paused PLC stays paused; the speed counts when it goes on. */
export async function setSpeed(speed: number): Promise<void> {
  await order(usePlc.getState().state?.state === "paused" ? "pause" : "continue", speed);
}

async function order(action: Action, speed: number | null): Promise<void> {
  const answer = await send({ type: "run", action, speed });
  useRun.setState({ refused: answer.ok ? null : answer.message || t("notsent") });
}

export async function chooseMode(mode: Mode): Promise<void> {
  const answer = await send({ type: "mode", mode });
  useRun.setState({ refused: answer.ok ? null : answer.message || t("notsent") });
}

/** F5: goes on when paused, pauses when running. */
export function toggleRun(): void {
  const state = usePlc.getState().state?.state;
  if (state === "running") void runAction("pause");
  if (state === "paused") void runAction("continue");
}

export function singleScan(): void {
  if (usePlc.getState().state?.state === "paused") void runAction("scan");
}
