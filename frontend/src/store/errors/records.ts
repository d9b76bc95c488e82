/** The shown error history: of the running program version, or of an earlier one; and imported test records. */

import { create } from "zustand";
import { everything, type HistoryView } from "../../logic/errors/history";
import { messageOf } from "../../logic/format/messageOf";
import { language, t } from "../../text";
import { rest } from "../../wire/rest";
import type { ErrorHistoryRow, HistoryVersion, ImportedRecord, RecordInfo } from "../../wire/types";
import { openPage } from "../page/navigate";
import { useBench } from "../plc/bench";
import { usePlc } from "../plc/plc";

interface Records {
  /** The PLC and the project that the other fields belong to. */
  instance: number | null;
  project: number | null;
  /** The newest first. */
  versions: readonly HistoryVersion[];
  /** Null: the history of the running version is shown, which comes by the socket. */
  old: { version: number; rows: readonly ErrorHistoryRow[] } | null;
  view: HistoryView;
  list: readonly RecordInfo[];
  /** The imported record that the page shows. */
  shown: number | null;
  record: ImportedRecord | null;
  /** The last refusal, in the server's words. */
  trouble: string | null;
}

const nothing: Records = {
  instance: null,
  project: null,
  versions: [],
  old: null,
  view: everything,
  list: [],
  shown: null,
  record: null,
  trouble: null,
};

export const useRecords = create<Records>(() => nothing);
const get = useRecords.getState;
const set = useRecords.setState;

export const setHistoryView = (view: Partial<HistoryView>) => set({ view: { ...get().view, ...view } });

async function guarded(deed: () => Promise<void>): Promise<void> {
  try {
    set({ trouble: null });
    await deed();
  } catch (error) {
    set({ trouble: messageOf(error) });
  }
}

// ---- the history of this PLC -----------------------------------------------------------------------------------

/** Loads the list of versions and of imported records: when the panel is shown first, and when a different program runs. */
export async function refreshRecords(): Promise<void> {
  const { instance, project } = useBench.getState();
  const now = { instance: instance?.id ?? null, project: project?.id ?? null };
  if (now.project !== get().project) set({ ...nothing, ...now });
  else if (now.instance !== get().instance) set({ ...now, versions: [], old: null });
  await guarded(async () => {
    const versions = now.instance === null ? [] : await rest.historyVersions(now.instance);
    const list = now.project === null ? [] : await rest.records(now.project);
    if (get().instance === now.instance && get().project === now.project) set({ versions, list });
  });
}

/** Shows the history of a version; without a version that of the running one. */
export function showVersion(version: number | null): Promise<void> {
  return guarded(async () => {
    const { instance } = get();
    const running = usePlc.getState().state?.program_version;
    if (version === null || version === running || instance === null) {
      set({ old: null });
      return;
    }
    const { rows } = await rest.historyOf(instance, version);
    if (get().instance === instance) set({ old: { version, rows } });
  });
}

// ---- test records ----------------------------------------------------------------------------------------------

type Format = "csv" | "xml" | "html";

/** The address of the test record of a PLC: of one version of its program, else of the running one. */
export function recordAddress(instance: number, format: Format, version?: number): string {
  const of = version === undefined ? "" : `&version=${version}`;
  return `/api/instances/${instance}/record?${query(format)}${of}`;
}

/** The address of an imported record as a file. */
export function importedAddress({ id, project }: RecordInfo, format: Format): string {
  return `/api/projects/${project}/records/${id}?${query(format)}`;
}

const query = (format: Format) => new URLSearchParams({ format, lang: language() }).toString();

/** Imports a test record, and shows it. */
export function importRecord(file: Blob): Promise<void> {
  return guarded(async () => {
    const { project } = get();
    if (project === null) return;
    const { id } = await rest.importRecord(project, file);
    set({ list: await rest.records(project) });
    showRecord(id);
  });
}

export function showRecord(id: number): void {
  set({ shown: id, record: get().record?.info.id === id ? get().record : null });
  openPage("record");
  void loadRecord();
}

/** Fetches the record that the page shows: also after a reload of the page. */
export async function loadRecord(): Promise<void> {
  if (get().project === null || get().project !== useBench.getState().project?.id) await refreshRecords();
  const { project, list, shown } = get();
  const id = shown ?? list[0]?.id ?? null;
  if (project === null || id === null) return;
  set({ shown: id });
  await guarded(async () => {
    const record = await rest.record(project, id);
    if (get().shown === id) set({ record });
  });
}

export async function deleteRecord({ id, project }: RecordInfo): Promise<void> {
  await rest.deleteRecord(project, id);
  const list = await rest.records(project);
  const next = list[0]?.id ?? null;
  set({ list, shown: next, record: null });
  if (next !== null) await loadRecord();
}

/** The title of the page's tab. */
export function useRecordTitle(): string {
  return useRecords(({ record }) =>
    record ? t("record.tab.of", { instance: record.record.instance }) : t("record.tab"),
  );
}
