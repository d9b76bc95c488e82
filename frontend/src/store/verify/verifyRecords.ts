/** Verifications that were kept in the project: fetched when the list is opened, because others keep some, too. */

import { create } from "zustand";
import { messageOf } from "../../logic/format/messageOf";
import type { VerificationRecord } from "../../wire/types";
import { type ExportFormat, endingOf, verify } from "../../wire/verify";
import { verifyRecords as wire } from "../../wire/verifyRecords";
import { saveFile } from "../page/download";
import { useBench } from "../plc/bench";
import { showVerifyRecord } from "./verify";

interface VerifyRecords {
  open: boolean;
  /** The newest first; null while they are being fetched. */
  list: readonly VerificationRecord[] | null;
  trouble: string | null;
}

export const useVerifyRecords = create<VerifyRecords>(() => ({ open: false, list: null, trouble: null }));
const get = useVerifyRecords.getState;
const set = useVerifyRecords.setState;

export function openVerifyRecords(): void {
  set({ open: true, list: null, trouble: null });
  void read();
}

export const closeVerifyRecords = () => set({ open: false });

async function read(): Promise<void> {
  const project = useBench.getState().project;
  if (!project) return set({ list: [] });
  try {
    const list = await wire.all(project.id);
    if (useBench.getState().project?.id === project.id) set({ list });
  } catch (error) {
    set({ list: get().list ?? [], trouble: messageOf(error) });
  }
}

/** Shows its rows in the Verification panel. */
export function openRecord(record: VerificationRecord): void {
  set({ open: false });
  showVerifyRecord(record);
}

export async function exportRecord({ id, name }: VerificationRecord, format: ExportFormat): Promise<void> {
  try {
    const file = await verify.export({ kind: "record", id }, format);
    saveFile(file, `${name.replace(/[\\/:*?"<>|]/g, "_")}.${endingOf(format)}`);
  } catch (error) {
    set({ trouble: messageOf(error) });
  }
}

/** Throws the refusal. */
export async function deleteRecord({ id }: VerificationRecord): Promise<void> {
  await wire.delete(id);
  await read();
}
