/** A look at the past alone: at a branch of the PLC, paused in that scan. The PLC itself goes on for the others. */
import { create } from "zustand";
import { messageOf } from "../../logic/format/messageOf";
import { copyName } from "../../logic/plc/instances";
import { keep, recall } from "../page/localStorage";
import { chooseInstance, useBench } from "./bench";
import { branch, deleteInstance } from "./instances";
import { answerTravel } from "./timeline";

interface Look {
  /** The PLC that one came from. */
  of: number;
  scan: number;
}

interface Alone {
  /** By the branch that was made for it. */
  looks: Readonly<Record<string, Look>>;
  busy: boolean;
  trouble: string | null;
}

const KEY = "looks";

export const useAlone = create<Alone>(() => ({ looks: recall(KEY, {}), busy: false, trouble: null }));

const get = useAlone.getState;
const set = useAlone.setState;

export const lookAlone = (scan: number) =>
  guarded(async () => {
    const { instance, app } = useBench.getState();
    if (!instance) return;
    const taken = (app?.instances ?? []).map(({ name }) => name);
    const made = await branch(instance, copyName(instance.name, taken), scan);
    keepLooks({ ...get().looks, [made.id]: { of: instance.id, scan } });
    answerTravel(false);
    await chooseInstance(made);
  });

/** Goes back to the PLC, and deletes the branch. */
export const endLook = () =>
  guarded(async () => {
    const { instance, app } = useBench.getState();
    const look = instance ? get().looks[instance.id] : undefined;
    if (!instance || !look) return;
    const origin = app?.instances.find(({ id }) => id === look.of);
    if (origin) await chooseInstance(origin);
    await deleteInstance(instance);
    const { [instance.id]: _ended, ...others } = get().looks;
    keepLooks(others);
  });

export const putAwayLookTrouble = () => set({ trouble: null });

function keepLooks(looks: Alone["looks"]): void {
  set({ looks });
  keep(KEY, looks);
}

async function guarded(deed: () => Promise<void>): Promise<void> {
  if (get().busy) return;
  set({ busy: true, trouble: null });
  try {
    await deed();
  } catch (error) {
    set({ trouble: messageOf(error) });
  } finally {
    set({ busy: false });
  }
}
