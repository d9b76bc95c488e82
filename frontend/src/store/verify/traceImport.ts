/** The import of a controller log: the file, the mapping of its columns, and the server's check of it. */

import { create } from "zustand";
import { messageOf } from "../../logic/format/messageOf";
import { carryOver, rangeOf, takeSaved } from "../../logic/verify/traceImport";
import { t } from "../../text";
import { Refused } from "../../wire/rest";
import { traceImport as wire } from "../../wire/traceImport";
import type {
  NewController,
  SavedMapping,
  TraceMapping,
  TraceMappingChecked,
  TraceProblem,
  UploadedTrace,
} from "../../wire/types";
import { useBench } from "../plc/bench";
import { onInstanceChange } from "../plc/reset";
import { addVerification } from "./verify";

interface TraceImport {
  open: boolean;
  /** The file that is being read. */
  reading: string | null;
  /** A file that was refused: why, and where. */
  refused: { name: string; message: string; problems: readonly TraceProblem[] } | null;
  trace: UploadedTrace | null;
  /** The mapping as it is edited. */
  mapping: TraceMapping | null;
  /** Name of the compared POU; empty: the whole program. */
  pou: string;
  /** The server's check of the current mapping; null while it is running. */
  checked: TraceMappingChecked | null;
  saved: readonly SavedMapping[];
  busy: boolean;
  /** The last refusal, or the problems of the mapping. */
  trouble: string | null;
  told: string | null;
}

const nothing: TraceImport = {
  open: false,
  reading: null,
  refused: null,
  trace: null,
  mapping: null,
  pou: "",
  checked: null,
  saved: [],
  busy: false,
  trouble: null,
  told: null,
};

export const useTraceImport = create<TraceImport>(() => nothing);
const get = useTraceImport.getState;
const set = useTraceImport.setState;

// A different project: the imported log does not belong to it.
onInstanceChange(({ otherProject }) => otherProject && set(nothing));

/** Opens the dialog as it was left. */
export function openTraceImport(file?: File): void {
  set({ open: true, trouble: null, told: null });
  void loadSaved();
  if (file) void readTrace(file);
  else void check();
}

export const closeTraceImport = () => set({ open: false });

/** Reads a file. After a refusal the previous file stays. */
export async function readTrace(file: File): Promise<void> {
  const project = useBench.getState().project;
  if (!project || get().reading !== null) return;
  set({ reading: file.name, refused: null, trouble: null, told: null });
  try {
    const trace = await wire.upload(project.id, file);
    if (trace.file === "") throw new BadFile(trace.problems);
    const { mapping: edited, trace: before } = get();
    const carried = edited && before ? { mapping: edited, proposal: before.mapping } : null;
    set({ trace, mapping: carryOver(carried, trace.mapping, trace.columns), checked: null });
    void check();
  } catch (error) {
    const problems = error instanceof BadFile ? error.problems : [];
    set({ refused: { name: file.name, message: problems.length > 0 ? "" : messageOf(error), problems } });
  } finally {
    set({ reading: null });
  }
}

/** Asks a controller what it has to read; it is read again and again while it is verified. */
export async function readController(wanted: NewController): Promise<void> {
  const project = useBench.getState().project;
  if (!project || get().reading !== null) return;
  set({ reading: wanted.address, refused: null, trouble: null, told: null });
  try {
    const trace = await wire.connect(project.id, wanted);
    set({ trace, mapping: trace.mapping, checked: null });
    void check();
  } catch (error) {
    set({ refused: { name: wanted.address, message: messageOf(error), problems: [] } });
  } finally {
    set({ reading: null });
  }
}

class BadFile extends Error {
  constructor(readonly problems: readonly TraceProblem[]) {
    super(t("import.trace.problems"));
  }
}

/** An edit of the mapping; the server checks it if no further edit follows at once. */
export function editMapping(mapping: TraceMapping): void {
  set({ mapping, checked: null, trouble: null, told: null });
  schedule();
}

export const chooseRange = (pou: string) => set({ pou });

const PAUSE = 250;
let timer: ReturnType<typeof setTimeout> | undefined;

function schedule(): void {
  clearTimeout(timer);
  timer = setTimeout(() => void check(), PAUSE);
}

/** Asks the server whether the file can be verified with the current mapping. */
async function check(): Promise<void> {
  clearTimeout(timer);
  const instance = useBench.getState().instance;
  const { trace, mapping, open } = get();
  if (!open || !instance || !trace || !mapping) return;
  try {
    const checked = await wire.check(instance.id, { file: trace.file, mapping });
    if (get().mapping === mapping && get().trace === trace) set({ checked, trouble: null });
  } catch (error) {
    if (get().mapping === mapping) set({ trouble: messageOf(error) });
  }
}

/** Verifies the log. The dialog stays open after a refusal. */
export async function beginTrace(): Promise<void> {
  const instance = useBench.getState().instance;
  const { trace, mapping, pou, busy } = get();
  if (!instance || !trace || !mapping || busy) return;
  set({ busy: true, trouble: null, told: null });
  try {
    addVerification(await wire.begin(instance.id, { file: trace.file, mapping, range: rangeOf(pou), limit: LIMIT }));
    set({ open: false });
  } catch (error) {
    const near = error instanceof Refused ? (error.refusal.near ?? []) : [];
    set({ trouble: [messageOf(error), ...near].join(" ") });
  } finally {
    set({ busy: false });
  }
}

/** The number of used variables that are recorded for each scan. */
const LIMIT = 4096;

// ---- saved mappings -------------------------------------------------------------------------------------------------

async function loadSaved(): Promise<void> {
  const project = useBench.getState().project;
  if (!project) return;
  try {
    const saved = await wire.saved(project.id);
    if (useBench.getState().project?.id === project.id) set({ saved });
  } catch (error) {
    set({ trouble: messageOf(error) });
  }
}

/** Throws the refusal. */
export async function saveMapping(name: string): Promise<void> {
  const project = useBench.getState().project;
  const { mapping } = get();
  if (!project || !mapping) return;
  await wire.save(project.id, name, mapping);
  set({ told: t("import.trace.saved", { name }) });
  await loadSaved();
}

export function loadMapping({ mapping: wanted }: SavedMapping): void {
  const { trace } = get();
  if (!trace) return;
  const { mapping, lost } = takeSaved(wanted, trace.columns);
  editMapping(mapping);
  const many = lost.length > 1;
  if (lost.length > 0)
    set({ told: t(many ? "import.trace.lost.many" : "import.trace.lost", { columns: lost.join(", ") }) });
}

export async function forgetMapping({ id }: SavedMapping): Promise<void> {
  try {
    await wire.forget(id);
  } catch (error) {
    set({ trouble: messageOf(error) });
  }
  await loadSaved();
}
