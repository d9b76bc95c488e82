/** Disturbances of the PLC: the active ones, the form for a new one, and the result of the last request. */

import { useSyncExternalStore } from "react";
import { create } from "zustand";
import { messageOf } from "../../logic/format/messageOf";
import { grouped } from "../../logic/format/numbers";
import { type DisturbForm, plainDisturbance, readDisturbance } from "../../logic/verify/disturb";
import { t } from "../../text";
import { disturbances as wire } from "../../wire/disturb";
import { Refused } from "../../wire/rest";
import type { CommandResult, DisturbanceInfo } from "../../wire/types";
import { showPanel } from "../page/navigate";
import { useBench } from "../plc/bench";
import { bindClock, readClock } from "../plc/clock";
import { onInstanceChange } from "../plc/reset";

interface Outcome {
  ok: boolean;
  message: string;
  /** Known names that are similar to the unknown one. */
  near: readonly string[];
}

interface Disturb {
  /** Those that are not over. */
  disturbances: readonly DisturbanceInfo[];
  form: DisturbForm;
  /** The result of the last request: shown in the form, or above the list. */
  outcome: Outcome | null;
  /** The form was sent and refused: missing entries are red from then on. */
  tried: boolean;
  busy: boolean;
}

const nothing: Disturb = {
  disturbances: [],
  form: plainDisturbance,
  outcome: null,
  tried: false,
  busy: false,
};

export const useDisturb = create<Disturb>(() => nothing);
const get = useDisturb.getState;
const set = useDisturb.setState;

onInstanceChange(() => set(nothing));

export const onDisturbances = (disturbances: readonly DisturbanceInfo[]) => set({ disturbances });

export const setDisturbance = (change: Partial<DisturbForm>) =>
  set(({ form }) => ({ form: { ...form, ...change }, outcome: null }));

/** The problems of the form; a future scan becomes a past one some time, without a key press. */
export function useTroubles(): ReturnType<typeof readDisturbance>["troubles"] {
  const form = useDisturb((state) => state.form);
  return JSON.parse(
    useSyncExternalStore(bindClock, () => JSON.stringify(readDisturbance(form, readClock().scan).troubles)),
  );
}

/** Opens the tab with the given fields filled in; other fields of the form stay. */
export function askDisturb(about: Partial<Pick<DisturbForm, "kind" | "path" | "site">>): void {
  const bit = about.path === undefined && about.site === undefined ? get().form.bit : "";
  set(({ form }) => ({ form: { ...form, ...about, bit }, outcome: null, tried: false }));
  showPanel("disturb");
}

/** Replaces an unknown name by a known one. */
export function mendDisturbance(name: string): void {
  setDisturbance(get().form.kind === "result" ? { site: name } : { path: name });
}

/** Injects the disturbance if the form is complete. */
export async function disturb(): Promise<void> {
  const { form } = get();
  const { wanted, troubles } = readDisturbance(form, readClock().scan);
  set({ tried: true, outcome: null });
  if (Object.keys(troubles).length > 0) return;
  const taken = await ordered((instance) => wire.define(instance, wanted));
  if (taken && get().form === form) set({ tried: false }); // else the next one is being entered
}

/** Takes back one disturbance; null takes back all of them. */
export async function calm(id: number | null): Promise<void> {
  await ordered((instance) => wire.takeBack(instance, id));
}

const capital = (text: string) => text.charAt(0).toUpperCase() + text.slice(1);

async function ordered(order: (instance: number) => Promise<CommandResult>): Promise<boolean> {
  const instance = useBench.getState().instance;
  if (!instance || get().busy) return false;
  set({ busy: true, outcome: null });
  const outcome = await order(instance.id).then(
    ({ ok, message, near, scan }): Outcome => ({
      ok,
      message: ok ? t("disturb.taken", { message: capital(message), scan: grouped(scan) }) : message,
      near: near ?? [],
    }),
    (error: unknown): Outcome => ({
      ok: false,
      message: messageOf(error) || t("notsent"),
      near: error instanceof Refused ? (error.refusal.near ?? []) : [],
    }),
  );
  set({ busy: false, outcome });
  return outcome.ok;
}
