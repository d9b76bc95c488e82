/** Comparisons of this run with others: the requests, their progress, and their results. */

import { create } from "zustand";
import { messageOf } from "../../logic/format/messageOf";
import { withNewest } from "../../logic/past/past";
import { past } from "../../wire/past";
import type { Comparison } from "../../wire/types";
import { openPage } from "../page/navigate";
import { useBench } from "../plc/bench";

interface Comparisons {
  /** Those of the selected instance, the newest first. */
  list: readonly Comparison[];
  /** Id of the shown one. */
  shown: number | null;
  /** The instance that is chosen to compare with. */
  other: number | null;
  trouble: string | null;
}

const nothing: Comparisons = { list: [], shown: null, other: null, trouble: null };

export const useComparisons = create<Comparisons>(() => nothing);
const get = useComparisons.getState;
const set = useComparisons.setState;

/** Opens the page "Compare runs", with an instance chosen to compare with. */
export function showCompare(other: number | null = null): void {
  set({ other: other ?? get().other, trouble: null });
  openPage("compare");
}

export const chooseOther = (other: number) => set({ other, trouble: null });
export const showComparison = (shown: number) => set({ shown, trouble: null });

/** Begins a comparison with the given instance, and shows it. */
export async function compareWithOther(other: number): Promise<void> {
  await guarded(async (instance) => {
    // The socket tells its state; the answer may come after its end was told.
    const { id } = await past.compare(instance, other);
    set({ shown: id });
  });
}

/** Cancels a running comparison, deletes a finished one. */
export async function forgetComparison(id: number): Promise<void> {
  await guarded(async () => {
    await past.forget(id);
    set(({ list, shown }) => ({
      list: list.filter((known) => known.id !== id),
      shown: shown === id ? null : shown,
    }));
  });
}

/** After each connection: fetches what the socket missed. */
export async function refreshComparisons(): Promise<void> {
  await guarded(async (instance) => {
    const list = await past.comparisons(instance);
    if (useBench.getState().instance?.id === instance) set({ list });
  });
}

/** The progress of a comparison of the selected instance. */
export function onComparison(comparison: Comparison): void {
  if (comparison.a !== useBench.getState().instance?.id) return;
  set(({ list }) => ({ list: withNewest(list, comparison) }));
}

async function guarded(deed: (instance: number) => Promise<void>): Promise<void> {
  const instance = useBench.getState().instance?.id;
  if (instance === undefined) return;
  try {
    set({ trouble: null });
    await deed(instance);
  } catch (error) {
    set({ trouble: messageOf(error) });
  }
}

/** The shown comparison: the chosen one, else the newest. */
export const shownComparison = ({ list, shown }: Comparisons): Comparison | null =>
  list.find(({ id }) => id === shown) ?? list[0] ?? null;

useBench.subscribe((now, before) => {
  if (now.instance?.id !== before.instance?.id) set(nothing);
});
