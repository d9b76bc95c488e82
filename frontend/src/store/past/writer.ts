/** Who last wrote a variable: asked of the run, answered by a statement, a command, or the PLC itself. */

import { create } from "zustand";
import { messageOf } from "../../logic/format/messageOf";
import { past } from "../../wire/past";
import type { LastWriter } from "../../wire/types";
import { openFile } from "../page/navigate";
import { useBench } from "../plc/bench";
import { travel } from "../plc/timeline";

interface Asked {
  /** As it was asked for; null while nothing is. */
  path: string | null;
  found: LastWriter | null;
  /** Why nothing was found. */
  refused: string | null;
}

const nothing: Asked = { path: null, found: null, refused: null };

export const useWriter = create<Asked>(() => nothing);
const set = useWriter.setState;

let turn = 0;

/** Opens the dialog. `scan`: who wrote it before that scan began; null: before what is shown now. */
export function showWriter(path: string, scan: number | null = null): void {
  void ask(path, scan);
}

async function ask(path: string, scan: number | null): Promise<void> {
  turn += 1;
  const mine = turn;
  const instance = useBench.getState().instance?.id;
  set({ ...nothing, path });
  if (instance === undefined) return;
  try {
    const found = await past.lastWriter(instance, path, scan);
    if (mine === turn) set({ found });
  } catch (error) {
    if (mine === turn) set({ refused: messageOf(error) });
  }
}

/** There was nothing to ask about: the dialog says why. */
export function refuseWriter(why: string): void {
  turn += 1;
  set({ path: "…", found: null, refused: why });
}

export function closeWriter(): void {
  turn += 1;
  set(nothing);
}

/** To the moment in front of the write, with its statement in sight. */
export function goToWriter({ scan, count, place }: LastWriter): void {
  closeWriter();
  if (place) openFile(place.file, place.line);
  void travel(scan, count);
}

// Another PLC: what was asked was about the one before.
useBench.subscribe((now, before) => {
  if (now.instance?.id !== before.instance?.id) closeWriter();
});
