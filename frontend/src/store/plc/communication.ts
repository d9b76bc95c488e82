/** The communication unit of the PLC: its servers of protocols. Asked again while somebody looks. */

import { create } from "zustand";
import { messageOf } from "../../logic/format/messageOf";
import { rest } from "../../wire/rest";
import type {
  Communication,
  CommunicationFault,
  CommunicationServerSettings,
  LineKind,
  ModbusRange,
  MqttSettingsGiven,
  PlantSettings,
  ServerKind,
} from "../../wire/types";
import { useBench } from "./bench";
import { onInstanceChange } from "./reset";

interface State {
  /** Null until the server has answered. */
  seen: Communication | null;
  /** Why it could not be asked. */
  trouble: string | null;
  /** The last change, where it was refused. */
  refused: { kind: LineKind | "mqtt"; message: string } | null;
  /** Null until somebody asked for it. */
  map: readonly ModbusRange[] | null;
}

const nothing: State = { seen: null, trouble: null, refused: null, map: null };
export const useCommunication = create<State>(() => nothing);
const set = useCommunication.setState;

onInstanceChange(() => set(nothing));

let turn = 0;

/** Of two answers only that of the later question counts. */
export async function loadCommunication(): Promise<void> {
  const { instance } = useBench.getState();
  if (instance === null) return;
  turn += 1;
  const mine = turn;
  try {
    const seen = await rest.communication(instance.id);
    if (mine === turn) set({ seen, trouble: null });
  } catch (error) {
    if (mine === turn) set({ trouble: messageOf(error) });
  }
}

let changes: Promise<unknown> = Promise.resolve();

/** Changes settings; each change begins with what the one before it made of them. */
export const changeServer = (kind: ServerKind, wanted: Partial<CommunicationServerSettings>) =>
  inTurn(kind, (instance) => {
    const settings = useCommunication.getState().seen?.servers.find((each) => each.kind === kind)?.settings;
    if (!settings) throw new Error(kind); // nobody sees a server that could be changed
    return rest.setCommunication(instance, kind, { ...settings, ...wanted });
  });

export const changePlant = (wanted: Partial<PlantSettings>) =>
  inTurn("plant", (instance) => {
    const settings = useCommunication.getState().seen?.plant.settings;
    if (!settings) throw new Error("plant"); // nobody sees a plant that could be changed
    return rest.setPlant(instance, { ...settings, ...wanted });
  });

export const changeMqtt = (wanted: Partial<MqttSettingsGiven>) =>
  inTurn("mqtt", (instance) => {
    const settings = useCommunication.getState().seen?.mqtt.settings;
    if (!settings) throw new Error("mqtt"); // nobody sees what could be changed
    return rest.setMqtt(instance, { ...settings, ...wanted });
  });

export const breakLine = (kind: LineKind, fault: CommunicationFault) =>
  inTurn(kind, (instance) => rest.breakLine(instance, kind, fault));

/** One change after the other: whether it was done. A refusal stays until the next change. */
function inTurn(kind: LineKind | "mqtt", change: (instance: number) => Promise<Communication>): Promise<boolean> {
  const { instance } = useBench.getState();
  if (instance === null) return Promise.resolve(false);
  const done = changes.then(async () => {
    try {
      const seen = await change(instance.id);
      turn += 1; // what was asked before the change does not know of it
      set({ seen, refused: null });
      return true;
    } catch (error) {
      set({ refused: { kind, message: messageOf(error) } });
      return false;
    }
  });
  changes = done;
  return done;
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
