/** The files of the project being edited: texts, unsaved changes, live problems and builds. */

import { messageOf } from "../../logic/format/messageOf";
import { forbidden } from "../../logic/plc/permits";
import { isPanelFile } from "../../logic/project/panelFiles";
import { skeleton } from "../../logic/project/skeleton";
import { t } from "../../text";
import { rest } from "../../wire/rest";
import type { BuildResult, FileInfo, FileText } from "../../wire/types";
import { doWaiting } from "../page/afterFrame";
import { inTurn } from "../page/inTurn";
import { openFile, showPanel } from "../page/navigate";
import { usePlc } from "../plc/plc";
import { onInstanceChange } from "../plc/reset";
import { check, scheduleCheck } from "./checking";
import { type BuildState, type Document, isDirty, nothing, patch, useDocuments, withLineFeeds } from "./documentState";
import { drop, dropAll, followDrafts, join, joinAgain, leave, refresh, sharedText, unsent } from "./drafts";
import { entered } from "./entering";
import { keepPending } from "./keeping";
import { bringDraft, forgetDraft, type KeptDraft, keepPlain, recallDraft } from "./keptDrafts";

export { type Document, isDirty, useDocuments } from "./documentState";

const get = useDocuments.getState;
const set = useDocuments.setState;

/** True when this browser has a text of the file that is stored nowhere else. */
export function holdsUnsaved(path: string): boolean {
  const { project, open } = get();
  if (open[path]) return isDirty(open[path]);
  return project !== null && recallDraft(project, path) !== null;
}

/** The text of a file as this browser has it; null where it has none but the saved one. */
export function textHere(path: string): string | null {
  const { project, open } = get();
  if (project === null) return null;
  return open[path]?.text ?? recallDraft(project, path)?.text ?? null;
}

/** Shows a different project: its files, and the compiler's problems with them. */
async function loadProject(project: number): Promise<void> {
  dropAll();
  set({ project, ...nothing });
  await refreshFiles();
  await check();
}

onInstanceChange(({ project, otherProject }) => otherProject && loadProject(project.id));

export async function refreshFiles(): Promise<void> {
  const { project } = get();
  if (project === null) return;
  const files = await rest.files(project);
  if (get().project === project) set({ files });
}

/** Fetches a file for editing: the draft that everybody shares; with what was typed here at the last visit and reached nobody. */
export async function openDocument(path: string): Promise<void> {
  const { project, open } = get();
  if (project === null || open[path]) return;
  const kept = bringDraft(project, path);
  const stored = await storedFile(project, path, kept !== null);
  if (get().project !== project || get().open[path]) return;
  const plain: Document = {
    path,
    text: kept?.text ?? stored?.text ?? "",
    savedText: stored?.text ?? "",
    version: stored ? (kept?.version ?? stored.version) : 0,
    savedAt: stored?.saved ?? "",
    savedBy: stored?.author ?? "",
    conflict: null,
    deletedBy: stored ? null : "",
    base: kept?.base,
  };
  if (stored) await join(path, () => before(get().open[path] ?? plain, bringDraft(project, path)));
  if (get().project !== project || get().open[path]) return;
  const shared = sharedText(path);
  const document =
    shared && stored ? { ...plain, text: shared.value, version: stored.version, base: undefined } : plain;
  set((state) => ({ open: { ...state.open, [path]: document } }));
  keepPending(path);
  if (isDirty(document)) scheduleCheck();
}

/** What is here of a file when its draft comes. A text of a draft that is gone is a text of no version: it is not merged. */
function before({ text, savedText, version, base }: Document, kept: KeptDraft | null) {
  return {
    text: withLineFeeds(text),
    saved: withLineFeeds(savedText),
    version: base === undefined ? version : null,
    unsent: kept?.unsent ?? [],
    base: base ?? null,
  };
}

/** Edits an open file together with the others, if it is not yet. */
async function share(path: string): Promise<void> {
  const { project, open } = get();
  const document = open[path];
  if (project === null || !document || document.deletedBy !== null || sharedText(path)) return;
  await join(path, () => before(get().open[path] ?? document, bringDraft(project, path)));
}

followDrafts({
  onText: (path) => {
    const shared = sharedText(path);
    if (shared) patch(path, { text: shared.value, base: undefined });
    scheduleCheck();
  },
  onUnsent: keepPending,
  onRefused: (path, refused) => get().open[path] && patch(path, { refused }),
  onEnd: (path) => {
    const document = get().open[path];
    // With the saved version that it is not of: to save it is a conflict, and shows both.
    if (isDirty(document)) patch(path, { version: 0 });
    else void share(path);
  },
});

/** Null when there is no such file; that is not a failure if the browser still has a text of it. */
async function storedFile(project: number, path: string, mayBeGone: boolean): Promise<FileText | null> {
  const known = get().files.some((file) => file.path === path);
  if (!known && !(await rest.files(project)).some((file) => file.path === path)) {
    if (mayBeGone) return null;
    throw new Error(t("file.gone", { path }));
  }
  return rest.file(project, path);
}

/** Stores an unsaved text in the browser; it is restored when the file is opened again. */
export function closeDocument(path: string): void {
  doWaiting();
  if (isDirty(get().open[path])) scheduleCheck();
  leave(path);
  set(({ open, active }) => {
    const { [path]: _closed, ...rest } = open;
    return { open: rest, active: active === path ? null : active };
  });
}

/** Whether this browser really stored the unsaved text: its storage may be full or switched off. */
export function isKept(path: string): boolean {
  doWaiting();
  const { project, open } = get();
  if (sharedText(path) && !unsent(path)) return true;
  return project !== null && recallDraft(project, path)?.text === open[path]?.text;
}

/** Discards the unsaved text, here and in the browser's storage. */
export function discardEdits(path: string): void {
  const { project, open } = get();
  const document = open[path];
  if (project === null || !document) return;
  const shared = sharedText(path);
  if (shared) {
    shared.replace(withLineFeeds(document.savedText));
    return;
  }
  forgetDraft(project, path);
  patch(path, { text: document.savedText, base: undefined });
  scheduleCheck();
}

export function edit(path: string, text: string): void {
  const { project, open } = get();
  const document = open[path];
  if (project === null || !document || document.text === text) return;
  const shared = sharedText(path);
  if (shared) {
    shared.replace(text);
    return;
  }
  patch(path, { text });
  const kept = recallDraft(project, path);
  if (text === document.savedText && !kept?.unsent.length) forgetDraft(project, path);
  else keepPlain(project, path, { text, version: document.version, base: document.base });
  scheduleCheck();
}

const saving = inTurn();

/**
 * Saves one file, after a save of it that is under way: its version is the one to begin from. False when it was not saved,
 * because somebody else saved first or the server refused.
 */
export function save(path: string): Promise<boolean> {
  const { project, open } = get();
  if (isDirty(open[path]) && isCutOff()) return Promise.resolve(false); // the one under way may have no answer for long
  return saving(`${project} ${path}`, () => saveNow(project, path));
}

async function saveNow(project: number | null, path: string): Promise<boolean> {
  const document = get().open[path];
  if (project === null || project !== get().project || !document) return false;
  if (!isDirty(document)) return true;
  if (isCutOff()) return false;
  const { text } = document;
  const shared = sharedText(path);
  try {
    const result = await rest.save(project, path, text, document.version, shared?.draft);
    if ("conflict" in result) {
      const { theirs } = result.conflict;
      const newer = shared && theirs.version > document.version;
      if (newer && (await refresh(path)) && shared === sharedText(path)) {
        // The draft has what they saved, too, and by now it is here: nothing is lost.
        patch(path, savedAs(theirs));
        return saveNow(project, path);
      }
      patch(path, { conflict: theirs });
      return false;
    }
    stored(path, text, result.saved);
    set({ trouble: null });
    return true;
  } catch (error) {
    set({ trouble: `${path}: ${messageOf(error)}` });
    return false;
  }
}

const savedAs = ({ text, version, saved, author }: FileText) => ({
  ...{ savedText: text, version, savedAt: saved ?? "", savedBy: author },
});

/** Without a connection a request would wait for ever, and would save unexpectedly later. */
function isCutOff(): boolean {
  const lost = usePlc.getState().link.state === "lost";
  if (lost) set({ trouble: t("lost.nosave") });
  return lost;
}

function stored(path: string, text: string, file: FileInfo): void {
  const { project, open, files } = get();
  patch(path, {
    savedText: text,
    version: file.version,
    savedAt: file.saved ?? "",
    savedBy: file.author,
    conflict: null,
    deletedBy: null,
    base: undefined,
  });
  if (project !== null && open[path]?.text === text && !unsent(path)) forgetDraft(project, path);
  void share(path);
  const others = files.filter((known) => known.path !== path);
  set({ files: [...others, file].sort((a, b) => a.path.localeCompare(b.path)) });
}

/** Ends a conflict: saves one's own text based on the other version, or takes the other version. */
export async function resolveConflict(path: string, choice: "mine" | "theirs"): Promise<void> {
  const { project, open } = get();
  const theirs = open[path]?.conflict;
  if (project === null || !theirs) return;
  if (choice === "theirs" && theirs.version === 0) {
    forgetDraft(project, path);
    closeDocument(path);
    await refreshFiles();
    return;
  }
  if (choice === "theirs") {
    patch(path, { text: theirs.text, ...savedAs(theirs), conflict: null, base: undefined });
    forgetDraft(project, path);
    void share(path);
    scheduleCheck();
    return;
  }
  patch(path, { ...savedAs(theirs), conflict: null });
  await save(path);
}

/** The message of the build that asked whether values may be lost. */
let asked = "";

/**
 * Saves all unsaved files, then builds; the running PLCs, or those `chosen`, get the new program in a seam. If values would be
 * lost, this happens only if `agreed`. `message` is kept with the version.
 */
export async function build(
  agreed = false,
  chosen: readonly number[] | null = null,
  message = agreed ? asked : "",
): Promise<void> {
  const { project, open } = get();
  if (project === null || get().build.phase === "running" || isCutOff()) return;
  const why = forbidden(usePlc.getState().state, true, "build");
  if (why !== null) {
    set({ build: refusedBuild(t(why)), asking: null });
    return;
  }
  // What is refused stays in its field, with the reason: the text is not what somebody wants to run.
  if (!(await entered())) return;
  set({ build: { phase: "running" }, asking: null });
  try {
    for (const document of Object.values(open)) {
      if (!(await save(document.path))) {
        set({ build: { phase: "idle" } });
        if (get().open[document.path]?.conflict) openFile(document.path);
        else showPanel("problems");
        return;
      }
    }
    asked = message;
    onBuilt(await rest.build(project, agreed, chosen, message), null);
  } catch (error) {
    set({ build: refusedBuild(messageOf(error)) });
  }
  const { build: now } = get();
  if (now.phase === "done" && !now.ok) showPanel("problems");
}

const refusedBuild = (message: string): BuildState => ({
  phase: "done",
  ok: false,
  message,
  author: null,
  changes: [],
  errors: [],
  at: new Date().toISOString(),
});

export function onBuilt(result: BuildResult, author: string | null): void {
  if (get().project !== result.project.id) return;
  if (result.needs_agreement) set({ build: { phase: "idle" }, asking: result });
  else {
    const swapped = result.ok && result.changes.some((change) => change.refusal === "");
    const { ok, message, changes } = result;
    const errors = result.problems.filter(({ severity }) => severity === "error");
    set({ build: { phase: "done", ok, message, author, changes, errors, at: new Date().toISOString() } });
    // A build that found nothing to do keeps the last change, so that it can still be rolled back.
    if (swapped) set({ change: result.changes });
  }
  const dirty = Object.values(get().open).some(isDirty);
  if (dirty) scheduleCheck();
  else set({ problems: result.problems, ...(result.pous.length > 0 ? { pous: result.pous } : {}) });
}

/** The result of the last build is shown only for the present: not in the past, and not after the program was rolled back. */
usePlc.subscribe(({ state }, { state: before }) => {
  if (!state || !before || get().build.phase !== "done") return;
  const shown = state.past !== null && before.past === null;
  const older = state.past === null && before.past === null && state.program_version < before.program_version;
  if (shown) set({ build: { phase: "idle" } });
  if (older) set({ build: { phase: "idle" }, change: null });
});

/** Nor after a file was added or deleted, which was not built. */
useDocuments.subscribe(({ build, files }, before) => {
  if (build.phase !== "done" || !build.ok || files === before.files || before.build !== build) return;
  const known = new Set(before.files.map(({ path }) => path));
  if (known.size !== files.length || files.some(({ path }) => !known.has(path))) set({ build: { phase: "idle" } });
});

/** Somebody (perhaps this browser) saved: an unedited text follows; an edited one shows the conflict when it is saved. */
export async function onSaved(file: FileInfo): Promise<void> {
  const { project, open, files } = get();
  const document = open[file.path];
  if (document?.deletedBy != null) patch(file.path, { deletedBy: null });
  if (!files.some((known) => known.path === file.path)) await refreshFiles();
  else set({ files: files.map((known) => (known.path === file.path && known.version < file.version ? file : known)) });
  if (sharedText(file.path)) await saving(`${project} ${file.path}`, async () => undefined); // perhaps it is an own one
  const shared = () => sharedText(file.path) !== undefined;
  const known = get().open[file.path];
  if (project === null || !known || (isDirty(known) && !shared()) || file.version <= known.version) {
    if (!isPanelFile(file.path)) scheduleCheck(); // no program has a panel
    return;
  }
  const fresh = await rest.file(project, file.path);
  const now = get().open[file.path];
  if (now && fresh.version > now.version) {
    const saved = savedAs(fresh);
    if (shared()) patch(file.path, saved);
    else if (!isDirty(now)) patch(file.path, { text: fresh.text, ...saved });
  }
  void share(file.path);
  scheduleCheck();
}

const deleting = new Set<string>();

/** Somebody deleted a file: its tab closes with the list of files, unless its text was edited. */
export async function onDeleted(path: string, author: string): Promise<void> {
  if (deleting.has(path)) return;
  drop(path);
  const { project, open } = get();
  const document = open[path];
  if (project !== null && document && isDirty(document)) {
    patch(path, { savedText: "", version: 0, conflict: null, deletedBy: author });
    keepPlain(project, path, { text: document.text, version: 0 });
  }
  set(({ files }) => ({ files: files.filter((file) => file.path !== path) }));
  scheduleCheck();
}

/** After a connection: catches up on files that others saved and deleted meanwhile. */
export async function catchUp(): Promise<void> {
  const { project } = get();
  if (project === null) return;
  joinAgain();
  let files: FileInfo[];
  try {
    files = await rest.files(project);
  } catch {
    return; // The connection was lost again: the next one catches up.
  }
  if (get().project !== project) return;
  const known = new Map(files.map((file) => [file.path, file]));
  for (const document of Object.values(get().open)) {
    const file = known.get(document.path);
    if (file && file.version > document.version) await onSaved(file);
    else if (!file && document.version > 0) await onDeleted(document.path, "");
    else void share(document.path);
  }
  if (get().project === project) set({ files });
}

/** Makes a new file, with a text that fits its name unless one is given. Throws the server's refusal. */
export async function createFile(path: string, text = skeleton(path)): Promise<void> {
  const { project } = get();
  if (project === null) return;
  const result = await rest.save(project, path, text, 0);
  if ("conflict" in result) throw new Error(result.conflict.message);
  await refreshFiles();
  scheduleCheck();
}

export async function deleteFile(path: string): Promise<void> {
  const { project } = get();
  if (project === null) return;
  deleting.add(path);
  try {
    await rest.deleteFile(project, path);
    forgetDraft(project, path);
    closeDocument(path);
    await refreshFiles();
  } finally {
    deleting.delete(path);
  }
  scheduleCheck();
}
