/** The words of inputs and outputs that the program uses, asked again for each program. */

import { create } from "zustand";
import { messageOf } from "../../logic/format/messageOf";
import { rest } from "../../wire/rest";
import type { Channel } from "../../wire/types";
import { openPage } from "../page/navigate";
import { useBench } from "../plc/bench";
import { onInstanceChange } from "../plc/reset";

interface Rack {
  /** Null until the PLC has answered. */
  channels: readonly Channel[] | null;
  trouble: string | null;
}

export const useRack = create<Rack>(() => ({ channels: null, trouble: null }));

export const openRack = () => openPage("rack");

let turn = 0;

export async function loadRack(): Promise<void> {
  const { instance } = useBench.getState();
  turn += 1;
  const mine = turn;
  if (instance === null) return useRack.setState({ channels: [], trouble: null });
  try {
    const channels = await rest.rack(instance.id);
    if (mine === turn) useRack.setState({ channels, trouble: null });
  } catch (error) {
    if (mine === turn) useRack.setState({ trouble: messageOf(error) });
  }
}

onInstanceChange(() => useRack.setState({ channels: null, trouble: null }));
