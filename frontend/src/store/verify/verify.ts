/** Verifications of the PLC: which exist, which one is shown, and the requests about them. */

import { create } from "zustand";
import { messageOf } from "../../logic/format/messageOf";
import { lineIn } from "../../logic/plc/sourceLines";
import type { RangeWish } from "../../logic/verify/verify";
import { t } from "../../text";
import { NoConnection, Refused } from "../../wire/rest";
import type { DriveVerification, NewVerification, VerificationInfo, VerificationRecord } from "../../wire/types";
import { type ExportFormat, endingOf, type VerifySource, verify as wire } from "../../wire/verify";
import { saveFile } from "../page/download";
import { showPanel } from "../page/navigate";
import { useBench } from "../plc/bench";
import { onInstanceChange } from "../plc/reset";
import { useDocuments } from "../project/documents";

/** What the dialog "New verification" begins with. */
export interface VerifyWish {
  range: RangeWish;
  /** A past stretch of scans; null is live. */
  stretch: { first: number; last: number } | null;
}

interface Verify {
  verifications: readonly VerificationInfo[];
  /** The shown verification, unless a record is shown. */
  id: number | null;
  record: VerificationRecord | null;
  asking: VerifyWish | null;
  /** `lost`: no more than a lost connection, which goes as soon as the server tells something again. */
  trouble: { message: string; near: readonly string[]; lost: boolean } | null;
}

const nothing: Verify = { verifications: [], id: null, record: null, asking: null, trouble: null };

export const useVerify = create<Verify>(() => nothing);
const get = useVerify.getState;
const set = useVerify.setState;

export interface ShownVerification {
  source: VerifySource;
  info: VerificationInfo;
  record: VerificationRecord | null;
}

/** The shown verification, or the shown record of one. */
export function shownOf({ verifications, id, record }: Pick<Verify, "verifications" | "id" | "record">) {
  if (record) return { source: { kind: "record", id: record.id }, info: record.info, record } as ShownVerification;
  const info = verifications.find((known) => known.id === id);
  return info ? ({ source: { kind: "verification", id: info.id }, info, record: null } as ShownVerification) : null;
}

export const shownNow = () => shownOf(get());

const instanceId = () => useBench.getState().instance?.id ?? null;

// ---- messages of the server --------------------------------------------------------------------------------------

export function resetVerify(): void {
  set(nothing);
}

onInstanceChange(resetVerify);

/** Counts the messages of the socket: one that came after a request was sent is newer than the answer. */
let told = 0;

/** When the panel is shown first and after a lost connection. */
export async function refreshVerifications(): Promise<void> {
  const instance = instanceId();
  if (instance === null) return;
  const before = told;
  try {
    const verifications = await wire.all(instance);
    if (instanceId() === instance && told === before) take(verifications);
  } catch (error) {
    fail(error);
  }
}

export function onVerifications(verifications: readonly VerificationInfo[]): void {
  told += 1;
  take(verifications);
}

/** The first verification is shown automatically; later ones only if this browser began them. */
function take(verifications: readonly VerificationInfo[]): void {
  set(({ id, trouble }) => ({
    verifications,
    trouble: trouble?.lost ? null : trouble,
    id: verifications.some((known) => known.id === id) ? id : (verifications.at(-1)?.id ?? null),
  }));
}

function put(info: VerificationInfo): void {
  set(({ verifications }) => ({
    verifications: verifications.some(({ id }) => id === info.id)
      ? verifications.map((known) => (known.id === info.id ? info : known))
      : [...verifications, info],
  }));
}

/** Sends a change; its answer is used only if the socket has reported nothing since. */
async function changed(request: Promise<VerificationInfo>): Promise<void> {
  const before = told;
  const info = await request;
  if (told === before && get().verifications.some(({ id }) => id === info.id)) put(info);
}

// ---- the view -----------------------------------------------------------------------------------------------------

export function chooseVerification(id: number): void {
  set({ id, record: null, trouble: null });
}

/** From other panels: also opens the tab. */
function showVerification(id: number): void {
  showPanel("verify");
  chooseVerification(id);
}

/** Takes and shows a verification from the answer to a request. */
export function addVerification(info: VerificationInfo): void {
  // A message of the socket that came meanwhile is newer than the answer.
  if (!get().verifications.some(({ id }) => id === info.id)) put(info);
  showVerification(info.id);
}

export function showVerifyRecord(record: VerificationRecord): void {
  showPanel("verify");
  set({ record, trouble: null });
}

/** Returns from a record to the verifications of this PLC. */
export const leaveRecord = () => set({ record: null });

// ---- beginning ----------------------------------------------------------------------------------------------------

export function askVerification(wish: VerifyWish): void {
  showPanel("verify");
  set({ asking: wish });
}

export const stopAsking = () => set({ asking: null });

/** Opens the dialog with a range of the program. */
const verifyRange = (range: RangeWish) => askVerification({ range, stretch: null });
export const verifyPou = (pou: string) => verifyRange({ pou });

/** Lines of an edited text, as line numbers of the built one. */
export function verifyLines(path: string, first: number, last: number): void {
  const document = useDocuments.getState().open[path];
  const built = (line: number) => (document ? lineIn(document.text, document.savedText, line) : line);
  verifyRange({ file: path, first: built(first), last: built(last) });
}

/** Opens the dialog with past scans, as selected on the timeline. */
export const verifyStretch = (first: number, last: number) => askVerification({ range: {}, stretch: { first, last } });

/** Throws the refusal. */
export async function beginVerification(wanted: NewVerification): Promise<void> {
  const instance = instanceId();
  if (instance === null) return;
  addVerification(await wire.begin(instance, wanted));
  set({ asking: null });
}

const WHOLE_SCAN = { pou: "", file: "", first: 0, last: 0, instance: "" };

/** Verifies the whole program from now on, without a dialog. */
export async function verifyWholeProgram(): Promise<void> {
  try {
    await beginVerification({ range: WHOLE_SCAN, pace: "free", first: null, last: null, limit: 4096 });
  } catch (error) {
    fail(error);
  }
}

// ---- driving ------------------------------------------------------------------------------------------------------

export function fail(error: unknown): void {
  const near = error instanceof Refused ? (error.refusal.near ?? []) : [];
  set({ trouble: { message: messageOf(error), near, lost: error instanceof NoConnection } });
}

/** Why a request was refused, with similar names. */
export function reasonOf(error: unknown): string {
  const near = error instanceof Refused ? (error.refusal.near ?? []) : [];
  return near.length > 0 ? `${messageOf(error)} ${t("verify.near", { near: near.join(", ") })}` : messageOf(error);
}

export const putAwayTrouble = () => set({ trouble: null });

export async function drive(how: Partial<DriveVerification>): Promise<boolean> {
  const shown = shownNow();
  if (shown?.source.kind !== "verification") return false;
  try {
    await changed(wire.drive(shown.source.id, { pace: null, auto: null, memory: null, action: null, ...how }));
    set({ trouble: null });
    return true;
  } catch (error) {
    fail(error);
    return false;
  }
}

/** Edits inputs of the set data; the monitor then runs on them. Null: accepted; else the refusal. */
export async function setCell(scan: number, call: number, column: string, value: string): Promise<string | null> {
  const shown = shownNow();
  if (shown?.source.kind !== "verification") return null;
  try {
    await changed(wire.setCells(shown.source.id, [{ scan, call, column, value }]));
    if (shown.info.memory !== "set") await drive({ memory: "set" });
    return null;
  } catch (error) {
    return messageOf(error);
  }
}

export async function deleteVerification(): Promise<void> {
  const shown = shownNow();
  if (shown?.source.kind !== "verification") return;
  const { id } = shown.source;
  try {
    await wire.delete(id);
    take(get().verifications.filter((known) => known.id !== id));
  } catch (error) {
    fail(error);
  }
}

/** Keeps it in the project. Throws the refusal. */
export async function keepVerification(name: string): Promise<void> {
  const shown = shownNow();
  if (shown?.source.kind === "verification") await wire.keep(shown.source.id, name);
}

export async function exportVerification(format: ExportFormat): Promise<void> {
  const shown = shownNow();
  if (!shown) return;
  try {
    const name = shown.record?.name ?? `${shown.info.title}, ${shown.info.first}`;
    saveFile(await wire.export(shown.source, format), `${name.replace(/[\\/:*?"<>|]/g, "_")}.${endingOf(format)}`);
  } catch (error) {
    fail(error);
  }
}
