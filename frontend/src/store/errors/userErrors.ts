/** The errors that the project defines itself, while somebody edits them: the stored version, the edited one, and its problems. */

import { create } from "zustand";
import { duplicate, freeId, idOf, newError, textOf, USER_ERRORS, withText } from "../../logic/errors/userErrors";
import { messageOf } from "../../logic/format/messageOf";
import { rest } from "../../wire/rest";
import type { FileInfo, FileText, UserError, UserErrors, UserErrorsDraft, UserProblem } from "../../wire/types";
import { saveFile } from "../page/download";
import { inTurn } from "../page/inTurn";
import { forget, keep, recall } from "../page/localStorage";
import { openPage } from "../page/navigate";
import { useBench } from "../plc/bench";
import { onSaved, refreshFiles } from "../project/documents";

interface State extends UserErrorsDraft {
  project: number | null;
  /** The stored errors, as JSON; null while they are being fetched. */
  stored: string | null;
  version: number;
  readable: boolean;
  problems: readonly UserProblem[];
  selected: number | null;
  /** The last request that failed. */
  trouble: string | null;
  /** The version of somebody else who saved first. */
  conflict: FileText | null;
  /** Saved here and not built since. */
  unbuilt: boolean;
  /** The empty fields of a new error: their problems are not shown until it is saved. */
  untouched: readonly string[];
}

const nothing: Omit<State, "project"> = {
  errors: [],
  groups: [],
  stored: null,
  version: 0,
  readable: true,
  problems: [],
  selected: null,
  trouble: null,
  conflict: null,
  unbuilt: false,
  untouched: [],
};

export const useUserErrors = create<State>(() => ({ project: null, ...nothing }));

const get = useUserErrors.getState;
const set = useUserErrors.setState;

interface Draft extends UserErrorsDraft {
  version: number;
}

const draftKey = (project: number) => `usererrors.${project}`;
const asStored = ({ errors, groups }: UserErrorsDraft) => JSON.stringify({ errors, groups });

/** Whether the page has edits that are stored nowhere else. */
export const isEdited = (state: State) => state.stored !== null && asStored(state) !== state.stored;

/** Opens the page, or returns to it; with an id it selects that error. */
export function openUserErrors(id?: string): void {
  openPage("usererrors");
  wanted = id ?? null;
  select();
}

let wanted: string | null = null;

function select(): void {
  const index = wanted === null ? -1 : get().errors.findIndex((error) => error.id === wanted);
  if (index < 0) return;
  wanted = null;
  set({ selected: index });
}

/** Reads the project's errors, unless they are being edited; unsaved edits of the last visit are restored. */
export async function loadUserErrors(project: number | null): Promise<void> {
  if (project !== get().project) set({ project, ...nothing });
  if (project === null || isEdited(get())) return;
  try {
    const found = await rest.userErrors(project);
    if (get().project === project && !isEdited(get())) take(found);
  } catch (error) {
    set({ trouble: messageOf(error) });
  }
}

function take(found: UserErrors): void {
  const { project, selected } = get();
  const { version, readable, problems } = found;
  const draft = project === null ? null : recall<Draft | null>(draftKey(project), null);
  const { errors, groups } = draft ?? found;
  const shown = selected !== null && selected < errors.length ? selected : errors.length > 0 ? 0 : null;
  set({
    ...{ errors, groups, readable, problems, selected: shown, trouble: null, conflict: null },
    stored: asStored(found),
    version: draft?.version ?? version,
  });
  if (draft) scheduleCheck();
  select();
}

function change(draft: Partial<UserErrorsDraft>, selected = get().selected): void {
  set({ ...draft, selected, trouble: null });
  const { project, errors, groups, version } = get();
  if (project === null) return;
  if (isEdited(get())) keep(draftKey(project), { errors, groups, version } satisfies Draft);
  else forget(draftKey(project));
  scheduleCheck();
}

export const selectUserError = (selected: number) => set({ selected, untouched: [] });

/** The problems to show. */
export const complaints = ({ problems, untouched }: Pick<State, "problems" | "untouched">): readonly UserProblem[] =>
  problems.filter(({ path }) => !untouched.includes(path));

export function edit(index: number, changed: Partial<UserError>): void {
  const touched = Object.keys(changed).map((field) => `errors.${index}.${field}`);
  const rest = get().untouched.filter(
    (path) => !touched.some((field) => path === field || path.startsWith(`${field}.`)),
  );
  set({ untouched: rest });
  change({ errors: get().errors.map((error, at) => (at === index ? { ...error, ...changed } : error)) });
}

/** Sets the name; the id follows it as long as nobody entered an id. */
export function rename(index: number, name: string): void {
  const { errors } = get();
  const error = errors[index];
  if (!error) return;
  const taken = errors.filter((other) => other !== error).map(({ id }) => id);
  const before = idOf(textOf(error.texts, "en", "name"));
  const follows = error.id === "" || error.id === freeId(before, taken);
  const id = idOf(name);
  edit(index, {
    texts: withText(error.texts, "en", "name", name),
    ...(follows ? { id: id === "" ? "" : freeId(id, taken) } : {}),
  });
}

export function addError(): void {
  const { errors } = get();
  change({ errors: [...errors, newError(errors, useBench.getState().model)] }, errors.length);
  set({ untouched: ["id", "code", "flag", "texts.0.name"].map((field) => `errors.${errors.length}.${field}`) });
}

export function duplicateError(index: number): void {
  const { errors } = get();
  const error = errors[index];
  if (!error) return;
  set({ untouched: [] });
  const copy = duplicate(error, errors, useBench.getState().model);
  change({ errors: errors.toSpliced(index + 1, 0, copy) }, index + 1);
}

export function deleteError(index: number): void {
  set({ untouched: [] });
  const errors = get().errors.toSpliced(index, 1);
  change({ errors }, errors.length === 0 ? null : Math.min(index, errors.length - 1));
}

/** Adds an example that works on the model, for a project without errors. */
export function addExample(example: UserError): void {
  const { errors } = get();
  change({ errors: [...errors, example] }, errors.length);
}

// ---- problems ----

const CHECK_DELAY = 150;
let timer: ReturnType<typeof setTimeout> | undefined;
let turn = 0;

function scheduleCheck(): void {
  clearTimeout(timer);
  timer = setTimeout(() => void check(), CHECK_DELAY);
}

/** Asks the server about the edited errors; an outdated answer is dropped. */
async function check(): Promise<void> {
  const { project, errors, groups } = get();
  if (project === null) return;
  turn += 1;
  const mine = turn;
  try {
    const { problems } = await rest.checkUserErrors(project, { errors, groups });
    if (mine === turn && get().project === project) set({ problems });
  } catch (error) {
    if (mine === turn) set({ trouble: messageOf(error) });
  }
}

// ---- storing ----

/** Writes errors.xml. A refusal, or the version of somebody who saved first, is shown; the edits stay. */
export function saveUserErrors(): Promise<void> {
  return saving("", async () => {
    const { project, errors, groups, version } = get();
    if (project === null || !isEdited(get())) return;
    clearTimeout(timer);
    set({ untouched: [] });
    await storing(project, () => rest.saveUserErrors(project, { errors, groups, version }));
  });
}

const saving = inTurn();

/** Imports the errors of a file, replacing the existing ones or in addition. True when they are stored. */
export async function importUserErrors(file: Blob, how: "replace" | "add"): Promise<string | null> {
  const { project, version } = get();
  if (project === null) return null;
  try {
    const result = await rest.importUserErrors(project, file, how, version);
    if ("conflict" in result) return result.conflict.message;
    await stored(project, result.saved);
    return null;
  } catch (error) {
    return messageOf(error);
  }
}

export async function exportUserErrors(): Promise<void> {
  const { project } = get();
  if (project === null) return;
  try {
    saveFile(await rest.exportUserErrors(project), USER_ERRORS);
  } catch (error) {
    set({ trouble: messageOf(error) });
  }
}

async function storing(project: number, request: () => ReturnType<typeof rest.saveUserErrors>): Promise<void> {
  try {
    const result = await request();
    if ("conflict" in result) set({ conflict: result.conflict.theirs, trouble: null });
    else await stored(project, result.saved);
  } catch (error) {
    set({ trouble: messageOf(error) });
    scheduleCheck();
  }
}

async function stored(project: number, saved: UserErrors): Promise<void> {
  forget(draftKey(project));
  if (get().project !== project) return;
  take(saved);
  set({ unbuilt: true });
  await refreshFiles();
  await onSaved({ path: USER_ERRORS, version: saved.version, author: "" });
}

/** Ends a conflict: saves one's own version over the other one, or reads the other one. */
export async function resolveUserConflict(choice: "mine" | "theirs"): Promise<void> {
  const { project, conflict } = get();
  if (project === null || !conflict) return;
  set({ version: conflict.version, conflict: null });
  if (choice === "mine") await saveUserErrors();
  else await discard();
}

/** Discards the edits. */
export async function discard(): Promise<void> {
  const { project } = get();
  if (project === null) return;
  forget(draftKey(project));
  set({ stored: null });
  await loadUserErrors(project);
}

/** Somebody saved a file: an unedited page follows; an edited one shows a conflict when it is saved. */
export function onFileSaved({ path, version }: FileInfo): void {
  const state = get();
  if (path === USER_ERRORS && version > state.version && !isEdited(state)) void loadUserErrors(state.project);
}

useBench.subscribe(({ project: now }, { project: before }) => {
  if (now?.id === before?.id && now?.version !== before?.version) set({ unbuilt: false });
});
