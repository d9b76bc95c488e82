/** Replays of a run with one error changed: the dialog, the progress, the instance that each produces. */

import { create } from "zustand";
import { messageOf } from "../../logic/format/messageOf";
import { withNewest } from "../../logic/past/past";
import { past } from "../../wire/past";
import type { NewRerun, Rerun } from "../../wire/types";
import { chooseInstance, refreshApp, useBench } from "../plc/bench";
import { showCompare } from "./comparisons";

/** The change that the dialog begins with. */
export interface RerunWish {
  /** The scan before which the error was raised. */
  scan: number;
  error: string;
  by: number;
  how: "same" | "instead" | "out";
}

interface Reruns {
  /** The change for which the dialog is open; null while it is closed. */
  wish: RerunWish | null;
  /** The replays of the selected instance: running, or done and not dismissed. */
  list: readonly Rerun[];
  trouble: string | null;
}

const nothing: Reruns = { wish: null, list: [], trouble: null };

export const useReruns = create<Reruns>(() => nothing);
const set = useReruns.setState;

/** Opens the dialog for an error that was raised before a scan. */
export function showRerun(of: { scan: number; error: string }, wish: Partial<RerunWish> = {}): void {
  set({ wish: { by: 0, how: "same", ...wish, ...of } });
}

export const closeRerun = () => set({ wish: null });

/** Its state is told over the socket. Throws the server's refusal. */
export async function beginRerun(wanted: NewRerun): Promise<void> {
  const instance = useBench.getState().instance?.id;
  if (instance === undefined) return;
  await past.rerun(instance, wanted);
}

export function onRerun(rerun: Rerun): void {
  set(({ list }) => ({ list: withNewest(list, rerun), trouble: null }));
  // The end of a replay is reported only to pages of this instance; the picker needs the new instance.
  if (rerun.instance !== null) refreshApp().catch(() => undefined);
}

export async function cancelRerun(id: number): Promise<void> {
  try {
    await past.cancelRerun(id);
    putAwayRerun(id);
  } catch (error) {
    set({ trouble: messageOf(error) });
  }
}

export const putAwayRerun = (id: number) => set(({ list }) => ({ list: list.filter((known) => known.id !== id) }));

/** Opens the instance that a replay produced. */
export async function openRerun({ id, instance }: Rerun): Promise<void> {
  await refreshApp();
  const made = useBench.getState().app?.instances.find((known) => known.id === instance);
  putAwayRerun(id);
  if (made) await chooseInstance(made);
}

/** Compares the original with the result of the replay. */
export async function compareRerun({ instance }: Rerun): Promise<void> {
  await refreshApp();
  showCompare(instance);
}

useBench.subscribe((now, before) => {
  if (now.instance?.id !== before.instance?.id) set(nothing);
});
