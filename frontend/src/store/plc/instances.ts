/** Every instance of this server with its load, while the list is open. */

import { create } from "zustand";
import { messageOf } from "../../logic/format/messageOf";
import { rest } from "../../wire/rest";
import { importRun, readBody } from "../../wire/transfer";
import type { ChangeInstance, ImportedInstance, Instance } from "../../wire/types";
import { saveFile } from "../page/download";
import { chooseInstance, chooseProject, refreshApp, useBench } from "./bench";

const PERIOD = 2000;

/** The transfer of a run file: which, and its progress; null is unknown. */
export interface Transfer {
  text: "import" | "export";
  name: string;
  share: number | null;
  cancel: () => void;
}

interface Instances {
  open: boolean;
  all: readonly Instance[];
  /** Null before the first answer, then the problem or an empty text. */
  trouble: string | null;
  /** The last import, if its file was damaged. */
  damaged: ImportedInstance | null;
  selected: number | null;
  transfer: Transfer | null;
}

export const useInstances = create<Instances>(() => ({
  open: false,
  all: [],
  trouble: null,
  damaged: null,
  selected: null,
  transfer: null,
}));

const get = useInstances.getState;
const set = useInstances.setState;

export function showInstances(open: boolean): void {
  const { app, instance } = useBench.getState();
  set({
    open,
    ...(open ? { all: app?.instances ?? [], selected: instance?.id ?? null, trouble: null } : {}),
    damaged: null,
  });
}

export const selectInstance = (selected: number | null) => set({ selected, trouble: null });

/** Requests the list repeatedly until the returned function is called. */
export function pollInstances(): () => void {
  let stopped = false;
  let timer: ReturnType<typeof setTimeout> | undefined;
  const turn = async () => {
    await refreshInstances();
    if (!stopped) timer = setTimeout(() => void turn(), PERIOD);
  };
  void turn();
  return () => {
    stopped = true;
    clearTimeout(timer);
  };
}

async function refreshInstances(): Promise<void> {
  try {
    set({ all: await rest.instances() });
  } catch (error) {
    set({ trouble: messageOf(error) });
  }
}

/** Performs an action on an instance; a refusal is shown above the buttons. */
async function carryOut(deed: () => Promise<unknown>): Promise<void> {
  try {
    set({ trouble: null });
    await deed();
  } catch (error) {
    set({ trouble: messageOf(error) });
  }
  await refreshInstances();
}

export function openInstance(instance: Instance): void {
  set({ open: false });
  void chooseInstance(instance);
}

/** Power off ends the process, power on starts it with the state it had. */
export function setPower(instance: Instance, power: boolean): Promise<void> {
  return carryOut(() => rest.changeInstance(instance.id, { power }));
}

/** Throws the server's refusal, so that a dialog can show it. */
export async function changeInstance(instance: Instance, change: Partial<ChangeInstance>): Promise<void> {
  const changed = await rest.changeInstance(instance.id, change);
  if (useBench.getState().instance?.id === changed.id) useBench.setState({ instance: changed });
  await Promise.all([refreshInstances(), refreshApp()]);
}

/** Makes a new instance from a scan of an existing one (null: from now). Throws the server's refusal. */
export async function branch(instance: Instance, name: string, scan: number | null, look = false): Promise<Instance> {
  const made = await rest.branch(instance.id, name, scan, look);
  await Promise.all([refreshInstances(), refreshApp()]);
  set({ selected: made.id });
  return made;
}

export async function deleteInstance(instance: Instance): Promise<void> {
  await rest.deleteInstance(instance.id);
  set({ selected: null });
  await Promise.all([refreshInstances(), refreshApp()]);
  const { app, instance: shown } = useBench.getState();
  if (shown?.id !== instance.id) return;
  const other = app?.instances[0];
  if (other) await chooseInstance(other);
  else await chooseProject(instance.project);
}

/** Downloads the whole run as one file. */
export function exportInstance(instance: Instance): Promise<void> {
  const given = new AbortController();
  const moving: Transfer = { text: "export", name: instance.name, share: null, cancel: () => given.abort() };
  return carryOut(() =>
    transferring(moving, async () => {
      const response = await rest.exportRun(instance.id, given.signal);
      const body = await readBody(response, progress);
      saveFile(body, nameIn(response) ?? `${instance.name}.scanrun`);
    }),
  );
}

/** Makes a new instance from a run file. Throws the server's refusal, so that the dialog can show it. */
export async function importInstance(name: string, file: File): Promise<void> {
  const given = new AbortController();
  set({ damaged: null });
  await transferring({ text: "import", name: file.name, share: 0, cancel: () => given.abort() }, async () => {
    const made = await importRun(name, file, progress, given.signal);
    set({ selected: made.id, damaged: made.damage === "" ? null : made });
    await Promise.all([refreshInstances(), refreshApp()]);
  });
}

/** A cancelled transfer is not a failure. */
async function transferring(transfer: Transfer, deed: () => Promise<void>): Promise<void> {
  set({ transfer, trouble: null });
  try {
    await deed();
  } catch (error) {
    if (!(error instanceof DOMException && error.name === "AbortError")) throw error;
  } finally {
    set({ transfer: null });
  }
}

function progress(share: number | null): void {
  const { transfer } = get();
  if (transfer) set({ transfer: { ...transfer, share } });
}

function nameIn(response: Response): string | undefined {
  return /filename="([^"]+)"/.exec(response.headers.get("Content-Disposition") ?? "")?.[1];
}
