/** Replays of a run with one error another: the dialog, how far they are, the instance that came of them. */

import { create } from "zustand";
import { messageOf } from "../../logic/format/messageOf";
import { withNewest } from "../../logic/past/past";
import { past } from "../../wire/past";
import type { NewRerun, Rerun } from "../../wire/types";
import { chooseInstance, refreshApp, useBench } from "../plc/bench";
import { showCompare } from "./comparisons";

/** What somebody wants to be another, before the dialog is filled in. */
export interface RerunWish {
  /** In front of which the error was raised. */
  scan: number;
  error: string;
  by: number;
  how: "same" | "instead" | "out";
}

interface Reruns {
  /** The dialog is open with it. */
  wish: RerunWish | null;
  /** Of the instance that is looked at: under way, or done and not put away. */
  list: readonly Rerun[];
  trouble: string | null;
}

const nothing: Reruns = { wish: null, list: [], trouble: null };

export const useReruns = create<Reruns>(() => nothing);
const set = useReruns.setState;

/** Opens the dialog for an error that was raised in front of a scan. */
export function showRerun(of: { scan: number; error: string }, wish: Partial<RerunWish> = {}): void {
  set({ wish: { by: 0, how: "same", ...wish, ...of } });
}

export const closeRerun = () => set({ wish: null });

/** Throws what the server said when it refuses. */
export async function beginRerun(wanted: NewRerun): Promise<void> {
  const instance = useBench.getState().instance?.id;
  if (instance === undefined) return;
  onRerun(await past.rerun(instance, wanted));
}

export function onRerun(rerun: Rerun): void {
  set(({ list }) => ({ list: withNewest(list, rerun), trouble: null }));
  // Its end is told to the pages of this instance only; the picker is to know the new one.
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

/** The instance that came of a replay. */
export async function openRerun({ id, instance }: Rerun): Promise<void> {
  await refreshApp();
  const made = useBench.getState().app?.instances.find((known) => known.id === instance);
  putAwayRerun(id);
  if (made) await chooseInstance(made);
}

/** The original beside what came of the replay. */
export async function compareRerun({ instance }: Rerun): Promise<void> {
  await refreshApp();
  showCompare(instance);
}

useBench.subscribe((now, before) => {
  if (now.instance?.id !== before.instance?.id) set(nothing);
});
