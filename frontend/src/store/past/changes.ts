/** What changed between two scans: asked of the run, shown in a dialog. */

import { create } from "zustand";
import { messageOf } from "../../logic/format/messageOf";
import { past } from "../../wire/past";
import type { RunChanges } from "../../wire/types";
import { useBench } from "../plc/bench";

interface Asked {
  /** The scans that were asked about; null while the dialog is closed. */
  stretch: { first: number; last: number } | null;
  found: RunChanges | null;
  refused: string | null;
}

const nothing: Asked = { stretch: null, found: null, refused: null };

export const useChanges = create<Asked>(() => nothing);
const set = useChanges.setState;

let turn = 0;

/** Opens the dialog: what is another at the beginning of scan `last` than at that of `first`. */
export function showChanges(first: number, last: number): void {
  void ask(Math.min(first, last), Math.max(first, last));
}

async function ask(first: number, last: number): Promise<void> {
  turn += 1;
  const mine = turn;
  const instance = useBench.getState().instance?.id;
  // What was found before stays in sight until the new answer is here.
  set({ stretch: { first, last }, refused: null });
  if (instance === undefined) return;
  try {
    const found = await past.changes(instance, first, last);
    if (mine === turn) set({ found });
  } catch (error) {
    if (mine === turn) set({ found: null, refused: messageOf(error) });
  }
}

export function closeChanges(): void {
  turn += 1;
  set(nothing);
}

useBench.subscribe((now, before) => {
  if (now.instance?.id !== before.instance?.id) closeChanges();
});
