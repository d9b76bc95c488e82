/** The communication unit of the PLC: its servers of protocols. Asked again while somebody looks. */

import { create } from "zustand";
import { messageOf } from "../../logic/format/messageOf";
import { rest } from "../../wire/rest";
import type {
  Communication,
  CommunicationFault,
  CommunicationServerSettings,
  ModbusRange,
  ServerKind,
} from "../../wire/types";
import { useBench } from "./bench";
import { onInstanceChange } from "./reset";

interface State {
  /** Null until the server has answered. */
  seen: Communication | null;
  /** Why it could not be asked, or changed. */
  trouble: string | null;
  /** Null until somebody asked for it. */
  map: readonly ModbusRange[] | null;
}

const nothing: State = { seen: null, trouble: null, map: null };
export const useCommunication = create<State>(() => nothing);
const set = useCommunication.setState;

onInstanceChange(() => set(nothing));

let turn = 0;

export const loadCommunication = () => ask((instance) => rest.communication(instance));

/** Changes settings, one change after the other: each begins with what the one before it made of them. */
export function changeServer(kind: ServerKind, wanted: Partial<CommunicationServerSettings>): void {
  changes = changes.then(async () => {
    const settings = useCommunication.getState().seen?.servers.find((each) => each.kind === kind)?.settings;
    if (settings) await ask((instance) => rest.setCommunication(instance, kind, { ...settings, ...wanted }));
  });
}

let changes: Promise<void> = Promise.resolve();

export const breakLine = (kind: ServerKind, fault: CommunicationFault) =>
  ask((instance) => rest.breakLine(instance, kind, fault));

/** Of two answers only that of the later question counts. */
async function ask(question: (instance: number) => Promise<Communication>): Promise<void> {
  const { instance } = useBench.getState();
  if (instance === null) return;
  turn += 1;
  const mine = turn;
  try {
    const seen = await question(instance.id);
    if (mine === turn) set({ seen, trouble: null });
  } catch (error) {
    if (mine === turn) set({ trouble: messageOf(error) });
  }
}

export async function loadMap(): Promise<void> {
  const { instance } = useBench.getState();
  if (instance === null) return;
  try {
    set({ map: await rest.modbusMap(instance.id) });
  } catch (error) {
    set({ trouble: messageOf(error) });
  }
}
