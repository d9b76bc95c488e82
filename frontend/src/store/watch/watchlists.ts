/** The watch lists of a project, and the shown one: stored on the server, shared with everybody or private. Simultaneous
 * edits of two people are merged; nobody's edit is lost. */

import { create } from "zustand";
import { messageOf } from "../../logic/format/messageOf";
import { type ListContent, merge, sameContent } from "../../logic/watch/watchlist";
import { t } from "../../text";
import { Refused, rest } from "../../wire/rest";
import type { WatchList, WatchListChanged, WatchListInfo } from "../../wire/types";
import { forget, keep, recall } from "../page/localStorage";

interface Shown {
  /** Null: it is not on the server yet. */
  id: number | null;
  /** The version on the server that `base` is. */
  version: number;
  base: ListContent;
  content: ListContent;
}

interface WatchLists extends Shown {
  project: number | null;
  lists: readonly WatchListInfo[];
  /** Why the shown list could not be saved; this browser keeps it, and tries again. */
  trouble: string | null;
  /** Who deleted the shown list. */
  deletedBy: string | null;
  /** An action that can be undone. */
  done: { text: string; undo: () => void } | null;
}

const EMPTY: ListContent = { name: "", shared: false, groups: [], entries: [] };
const nothing: WatchLists = {
  project: null,
  lists: [],
  id: null,
  version: 0,
  base: EMPTY,
  content: EMPTY,
  trouble: null,
  deletedBy: null,
  done: null,
};

export const useWatchLists = create<WatchLists>(() => nothing);
const get = useWatchLists.getState;
const set = useWatchLists.setState;

const HISTORY = 100;
let history: ListContent[] = [];
let first: readonly string[] = [];
/** Running saves, by project: the save of a project that was left ends beside that of the shown one. */
const saving = new Map<number, Promise<void>>();
/** The newest reported version of the shown list. */
let newest = 0;

const chosenKey = (project: number | null) => `watchlist.${project}`;
const pendingKey = (project: number | null) => `watchlist.unsaved.${project}`;
const isSaving = () => saving.has(get().project ?? -1);
const isEdited = () => !sameContent(get().base, get().content);

/** On a change of project: shows the list of the last visit, else a shared one, else a new one with the project's default content. */
export async function loadWatchLists(project: number | null, begin: readonly string[]): Promise<void> {
  if (project === get().project) return;
  first = begin;
  history = [];
  newest = 0;
  set({ ...nothing, ...fresh(), project });
  if (project === null) return;
  const unsaved = recall<Shown | null>(pendingKey(project), null);
  if (unsaved) set(unsaved);
  await refreshLists();
  if (get().project !== project) return;
  if (unsaved) void save();
  else await chooseKept(project);
}

async function chooseKept(project: number): Promise<void> {
  const { lists } = get();
  const kept = recall<number | null>(chosenKey(project), null);
  const known = lists.find(({ id }) => id === kept) ?? lists.find(({ shared }) => !shared) ?? lists[0];
  if (known && !isEdited()) await chooseList(known.id);
}

/** A new private list: with the project's default content, or empty. */
function fresh(paths: readonly string[] = first): Shown {
  const entries = paths.map((path) => ({ path, group: "", format: "default" as const }));
  const content: ListContent = { name: freeName(t("watch.list.new")), shared: false, groups: [], entries };
  return { id: null, version: 0, base: content, content };
}

function freeName(wanted: string): string {
  const taken = new Set(get().lists.map(({ name }) => name));
  for (let number = 2, name = wanted; ; number += 1) {
    if (!taken.has(name)) return name;
    name = `${wanted} ${number}`;
  }
}

const contentOf = ({ name, shared, groups, entries }: WatchList): ListContent => ({ name, shared, groups, entries });

async function refreshLists(): Promise<void> {
  const { project } = get();
  if (project === null) return;
  try {
    const lists = await rest.watchLists(project);
    if (get().project === project) set({ lists });
  } catch (error) {
    set({ trouble: messageOf(error) });
  }
}

function take(list: WatchList): void {
  const content = contentOf(list);
  history = [];
  newest = list.version;
  set({ id: list.id, version: list.version, base: content, content, trouble: null, deletedBy: null });
  keep(chosenKey(get().project), list.id);
}

export async function chooseList(id: number): Promise<void> {
  const { project } = get();
  if (!(await saved(project))) return;
  try {
    const list = await rest.watchList(id);
    if (await saved(project)) take(list); // edits made meanwhile are saved, too
  } catch (error) {
    if (get().project === project) set({ trouble: messageOf(error) });
  }
}

/** Whether a different list may replace the shown one: nothing would be lost. */
async function saved(project: number | null): Promise<boolean> {
  if (get().project === project && isEdited()) await save();
  return get().project === project && !isEdited();
}

/** Makes an empty private list; it is stored with its first entry. */
export async function newList(): Promise<void> {
  if (!(await saved(get().project))) return;
  history = [];
  set({ ...fresh([]), trouble: null, deletedBy: null });
}

/** Changes the shown list; it is saved automatically. */
export function editList(change: (content: ListContent) => ListContent): void {
  const { content } = get();
  const next = change(content);
  if (next === content) return;
  history = [...history.slice(-HISTORY), content];
  set({ content: next, done: null });
  void save();
}

/** Undoes the last change. */
export function undoEdit(): void {
  const before = history.pop();
  if (!before) return;
  set({ content: before, done: null });
  void save();
}

export function told(text: string, undo: () => void): void {
  set({ done: { text, undo } });
}

/** Saves until there is nothing to save; a version that somebody saved first is merged with the one here. */
function save(): Promise<void> {
  const { project, id, version, base, content } = get();
  if (project === null) return Promise.resolve();
  keep(pendingKey(project), { id, version, base, content } satisfies Shown);
  const begun = saving.get(project) ?? saveAll(project);
  saving.set(project, begun);
  return begun;
}

async function saveAll(project: number): Promise<void> {
  try {
    do await saveOnce(project);
    while (get().project === project && isEdited());
    if (get().project === project) {
      set({ trouble: null });
      forget(pendingKey(project));
    }
  } catch (error) {
    if (get().project !== project) return; // the content is kept, and saved when the project is shown again
    if (error instanceof Refused && error.status === 404 && get().id !== null) onGone("");
    else set({ trouble: messageOf(error) });
  } finally {
    saving.delete(project);
  }
  if (get().project !== project) return;
  const { id, version } = get();
  if (id !== null && newest > version) void pull(id);
  void refreshLists();
}

/** A list was saved whose project was left meanwhile: later changes continue from this version when it is shown again. */
function settle(project: number, sent: ListContent, now: WatchList): void {
  const kept = recall<Shown | null>(pendingKey(project), null);
  if (kept === null || (kept.id !== null && kept.id !== now.id)) return;
  if (sameContent(kept.content, sent)) {
    forget(pendingKey(project));
    return;
  }
  const name = kept.content.name === sent.name ? now.name : kept.content.name;
  const content = { ...kept.content, name };
  keep(pendingKey(project), { id: now.id, version: now.version, base: contentOf(now), content } satisfies Shown);
}

async function saveOnce(project: number): Promise<void> {
  const { id, version, content } = get();
  if (id === null) {
    const made = await created(project, content);
    if (get().project !== project) {
      settle(project, content, made);
      keep(chosenKey(project), made.id);
      return;
    }
    if (get().id !== null) return;
    const now = get().content;
    const named = now.name === content.name ? { ...now, name: made.name } : now;
    set({ id: made.id, version: made.version, base: contentOf(made), content: named, deletedBy: null });
    newest = made.version;
    keep(chosenKey(project), made.id);
    return;
  }
  const answer = await rest.saveWatchList(id, content, version);
  if (get().project !== project) {
    if ("saved" in answer) settle(project, content, answer.saved);
    return;
  }
  if (get().id !== id) return;
  if ("saved" in answer) set({ version: answer.saved.version, base: contentOf(answer.saved) });
  else takeTheirs(answer.theirs);
}

/** Saves it under its name, or with the next free number. */
async function created(project: number, content: ListContent): Promise<WatchList> {
  for (let number = 2, name = content.name; ; number += 1) {
    try {
      return await rest.createWatchList(project, { ...content, name });
    } catch (error) {
      if (!(error instanceof Refused && error.status === 409) || number > 99) throw error;
      name = `${content.name} ${number}`;
    }
  }
}

function takeTheirs(theirs: WatchList): void {
  const { base, content } = get();
  const their = contentOf(theirs);
  set({ content: merge(base, content, their), base: their, version: theirs.version });
  newest = Math.max(newest, theirs.version);
}

/** A list was changed, by this browser or by somebody else. */
export async function onWatchList({ id, version, author }: WatchListChanged): Promise<void> {
  if (id === get().id && version === 0) onGone(author);
  else if (id === get().id) {
    newest = Math.max(newest, version);
    if (version > get().version && !isSaving()) await pull(id);
  }
  if (!isSaving()) await refreshLists();
}

async function pull(id: number): Promise<void> {
  try {
    const theirs = await rest.watchList(id);
    if (get().id === id && theirs.version > get().version) takeTheirs(theirs);
  } catch (error) {
    set({ trouble: messageOf(error) });
  }
}

/** The shown list stays until a different one is chosen. */
function onGone(author: string): void {
  forget(pendingKey(get().project));
  set(({ content }) => {
    const own = { ...content, shared: false };
    return { id: null, version: 0, base: own, content: own, deletedBy: author || t("somebody") };
  });
}

/** After a connection was lost: fetches what others did, and saves what could not be saved. */
export async function catchUpLists(): Promise<void> {
  await refreshLists();
  const { id, version, lists } = get();
  if (isEdited()) await save();
  else if (id !== null && (lists.find((list) => list.id === id)?.version ?? version) > version) await pull(id);
}

/** Makes a private list out of one that somebody deleted. */
export const keepAsOwn = () => save();

export function renameList(name: string): void {
  editList((content) => ({ ...content, name }));
}

export async function duplicateList(): Promise<void> {
  const { content } = get();
  if (!(await saved(get().project))) return;
  await begin({ ...content, shared: false, name: freeName(t("watch.list.copy", content)) });
}

/** Shares the list with everybody at the project. Others may use it from then on, so it cannot become private again. */
export function shareList(): void {
  editList((content) => ({ ...content, shared: true }));
  history = [];
}

/** Deletes the shown list. This can be undone: the same list gets a different id. */
export async function deleteList(): Promise<void> {
  await saving.get(get().project ?? -1); // otherwise a running save would create it again
  const { id, content, project } = get();
  try {
    set({ id: null }); // messages about it are ignored
    if (id !== null) await rest.deleteWatchList(id);
  } catch (error) {
    set({ id, trouble: messageOf(error) });
    return;
  }
  forget(pendingKey(project));
  forget(chosenKey(project));
  set({ ...fresh([]), deletedBy: null, trouble: null });
  await refreshLists();
  if (project !== null) await chooseKept(project);
  told(t("watch.list.deleted", content), () => void begin(content));
}

async function begin(content: ListContent): Promise<void> {
  history = [];
  set({ id: null, version: 0, base: EMPTY, content, done: null, deletedBy: null });
  await save();
}
