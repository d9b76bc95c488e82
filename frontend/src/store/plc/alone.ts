/** A look at the past alone: at a branch of the PLC, paused in that scan. The PLC itself goes on for the others. */
import { create } from "zustand";
import { messageOf } from "../../logic/format/messageOf";
import { copyName } from "../../logic/plc/instances";
import { chooseInstance, useBench } from "./bench";
import { branch, deleteInstance } from "./instances";
import { keepLooks, keptLooks, type Looks } from "./looks";
import { answerTravel } from "./timeline";

interface Alone {
  looks: Looks;
  busy: boolean;
  trouble: string | null;
}

export const useAlone = create<Alone>(() => ({ looks: keptLooks(), busy: false, trouble: null }));

const get = useAlone.getState;
const set = useAlone.setState;

export const lookAlone = (scan: number) =>
  guarded(async () => {
    const { instance, app } = useBench.getState();
    if (!instance) return;
    const taken = (app?.instances ?? []).map(({ name }) => name);
    const made = await branch(instance, copyName(instance.name, taken), scan, true);
    setLooks({ ...get().looks, [made.id]: { of: instance.id, scan } });
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
    setLooks(others);
  });

export const putAwayLookTrouble = () => set({ trouble: null });

function setLooks(looks: Looks): void {
  set({ looks });
  keepLooks(looks);
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
