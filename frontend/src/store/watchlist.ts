/** The watch list of this browser for one instance: entries, unfolded rows, what was typed, what was refused. */
import { create } from "zustand";
import type { Format } from "../logic/values";
import { pathsToWatch, type WatchListView, type WatchNote, watchRows } from "../logic/watchrows";
import { type Answer, send } from "../wire/send";
import { keep, recall } from "./keep";
import { loadMembers, useMembers } from "./members";
import { useWatches, watch } from "./watches";

interface WatchList {
  instance: number | null;
  roots: readonly string[];
  open: ReadonlySet<string>;
  notes: ReadonlyMap<string, WatchNote>;
  drafts: ReadonlyMap<string, string>;
  formats: ReadonlyMap<string, Format>;
  selected: string | null;
}

interface Kept {
  roots: string[];
  open: string[];
  formats: [string, Format][];
}

const nothing: WatchList = {
  instance: null,
  roots: [],
  open: new Set(),
  notes: new Map(),
  drafts: new Map(),
  formats: new Map(),
  selected: null,
};

export const useWatchList = create<WatchList>(() => nothing);
const get = useWatchList.getState;
const set = useWatchList.setState;

let release: () => void = () => undefined;

/** Shows the list that this browser kept for an instance, or the project's first one. */
export function loadWatchList(instance: number | null, first: readonly string[]): void {
  const kept = recall<Kept>(`watch.${instance}`, { roots: [...first], open: [], formats: [] });
  set({ ...nothing, instance, roots: kept.roots, open: new Set(kept.open), formats: new Map(kept.formats) });
  void refreshMembers();
}

/** Fetches the members of all that is unfolded; after a build they may be others. */
export async function refreshMembers(): Promise<void> {
  const paths = [...get().open].sort((a, b) => a.length - b.length);
  for (const path of paths) await loadMembers(path);
  sync();
}

function viewOf(list: WatchList): WatchListView {
  return {
    roots: list.roots,
    open: list.open,
    notes: list.notes,
    members: useMembers.getState().of,
    symbols: useWatches.getState().symbols,
    refusals: useWatches.getState().refusals,
  };
}

function sync(): void {
  const before = release;
  release = watch(pathsToWatch(watchRows(viewOf(get()))));
  before();
}

function changed(): void {
  const { instance, roots, open, formats } = get();
  if (instance !== null) {
    keep(`watch.${instance}`, { roots: [...roots], open: [...open], formats: [...formats] } satisfies Kept);
  }
  sync();
}

export function addToWatch(paths: readonly string[]): void {
  const fresh = [...new Set(paths)].filter((path) => !get().roots.includes(path));
  set(({ roots }) => ({ roots: [...roots, ...fresh], selected: paths.at(-1) ?? null }));
  changed();
}

export function removeFromWatch(root: string): void {
  set(({ roots, notes, drafts }) => ({
    roots: roots.filter((path) => path !== root),
    notes: without(notes, root),
    drafts: without(drafts, root),
    selected: null,
  }));
  changed();
}

/** Another name for an entry that could not be found. */
export function replaceInWatch(root: string, path: string): void {
  set(({ roots }) => ({ roots: roots.map((entry) => (entry === root ? path : entry)), selected: path }));
  changed();
}

export async function toggleOpen(path: string): Promise<void> {
  const open = new Set(get().open);
  if (open.delete(path)) {
    set({ open });
    changed();
    return;
  }
  await loadMembers(path);
  set({ open: new Set(get().open).add(path) });
  changed();
}

export function select(path: string | null): void {
  set({ selected: path });
}

export function setFormat(path: string, format: Format): void {
  set(({ formats }) => ({ formats: new Map(formats).set(path, format) }));
  changed();
}

export function setDraft(path: string, text: string): void {
  set(({ drafts, notes }) => ({
    drafts: text === "" ? without(drafts, path) : new Map(drafts).set(path, text),
    notes: without(notes, path),
  }));
}

export async function write(path: string, value: string): Promise<void> {
  landed(path, value, await send({ type: "write", path, value }));
}

export async function force(path: string, value: string): Promise<void> {
  landed(path, value, await send({ type: "force", path, value }));
}

export async function releaseForce(path: string | null): Promise<void> {
  const answer = await send({ type: "release", path });
  if (!answer.ok && path !== null) landed(path, "", answer);
}

function landed(path: string, entry: string, answer: Answer): void {
  if (answer.ok) {
    set(({ drafts, notes }) => ({
      drafts: drafts.get(path) === entry ? without(drafts, path) : drafts,
      notes: without(notes, path),
    }));
    return;
  }
  const note: WatchNote = {
    kind: answer.sent ? "refused" : "unsent",
    message: answer.message,
    near: answer.near ?? [],
    entry,
  };
  set(({ notes }) => ({ notes: new Map(notes).set(path, note) }));
}

function without<V>(map: ReadonlyMap<string, V>, key: string): ReadonlyMap<string, V> {
  if (!map.has(key)) return map;
  const next = new Map(map);
  next.delete(key);
  return next;
}
