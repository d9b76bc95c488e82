/** How this browser shows its watch list: what is unfolded and visible, the sort and the filter, typed values, refusals. */

import { create } from "zustand";
import { type Format, literalOf } from "../../logic/format/formats";
import { chosenFor, splitPath } from "../../logic/format/paths";
import { addEntries, removeEntry, replacePath, setFormat as withFormat } from "../../logic/watch/watchlist";
import { noteOf, outsideNote, PAGE, type WatchNote } from "../../logic/watch/watchrows";
import { type Filter, needsAll, nextSort, type Sort, type SortColumn } from "../../logic/watch/watchsort";
import { t } from "../../text";
import { type Answer, send } from "../../wire/send";
import type { WatchEntry } from "../../wire/types";
import { keep, recall } from "../page/localStorage";
import { loadMembers, useMembers } from "../plc/members";
import { usePlc } from "../plc/plc";
import { onInstanceChange } from "../plc/reset";
import { changeMark, currentText } from "../plc/values";
import { useWatches, watch } from "../plc/watches";
import { editList, loadWatchLists, told, undoEdit, useWatchLists } from "./watchlists";

interface WatchView {
  project: number | null;
  open: ReadonlySet<string>;
  collapsed: ReadonlySet<string>;
  shown: ReadonlyMap<string, number>;
  notes: ReadonlyMap<string, WatchNote>;
  drafts: ReadonlyMap<string, string>;
  /** Formats of members; the format of an entry is in the list. */
  formats: ReadonlyMap<string, Format>;
  /** The call site that a write of an in-out goes to, if it is not the last one: `file:line` by path. */
  sites: ReadonlyMap<string, string>;
  selected: string | null;
  sort: Sort;
  filter: Filter;
  /** Values that changed after this mark pass the filter "changed". */
  since: number;
}

interface Kept {
  open: string[];
  collapsed: string[];
  formats: [string, Format][];
}

const nothing: WatchView = {
  project: null,
  open: new Set(),
  collapsed: new Set(),
  shown: new Map(),
  notes: new Map(),
  drafts: new Map(),
  formats: new Map(),
  sites: new Map(),
  selected: null,
  sort: null,
  filter: { text: "", only: "all" },
  since: 0,
};

export const useWatchList = create<WatchView>(() => nothing);
const get = useWatchList.getState;
const set = useWatchList.setState;

const keptKey = (project: number | null) => `watchview.${project}`;

/** Shows the lists of a project; `first` is the content of its first list. */
function loadWatchList(project: number | null, first: readonly string[]): void {
  if (project !== get().project) {
    const kept = recall<Partial<Kept>>(keptKey(project), {});
    set({
      ...nothing,
      project,
      open: new Set(kept.open),
      collapsed: new Set(kept.collapsed),
      formats: new Map(kept.formats),
    });
  }
  void loadWatchLists(project, first);
  void refreshMembers();
}

onInstanceChange(({ project }) => loadWatchList(project.id, project.watch));

function keepView(): void {
  const { project, open, collapsed, formats } = get();
  if (project === null) return;
  keep(keptKey(project), { open: [...open], collapsed: [...collapsed], formats: [...formats] } satisfies Kept);
}

/** Fetches the members of everything that is unfolded; after a build they may differ. */
export async function refreshMembers(): Promise<void> {
  const paths = [...get().open].sort((a, b) => a.length - b.length);
  for (const path of paths) await loadMembers(path);
}

usePlc.subscribe(({ state: now }, { state: before }) => {
  if (now && before && now.program_version !== before.program_version) void refreshMembers();
});

// ---- what is watched --------------------------------------------------------------------------------------------------

const LINGER = 120;
let sight: () => void = () => undefined;
let entries: { of: readonly WatchEntry[]; release: () => void } | null = null;
let waiting: ReturnType<typeof setTimeout> | undefined;

/** Watches the visible rows, and all entries if a sort or a filter needs them. */
export function watchInSight(paths: readonly string[]): void {
  clearTimeout(waiting);
  waiting = setTimeout(() => {
    watchEntries();
    const before = sight;
    sight = watch(paths);
    before();
  }, LINGER);
}

function watchEntries(): void {
  const { sort, filter } = get();
  const wanted = needsAll(sort, filter) ? useWatchLists.getState().content.entries : null;
  if (wanted === (entries?.of ?? null)) return;
  const before = entries;
  entries = wanted && { of: wanted, release: watch(wanted.map(({ path }) => path)) };
  before?.release();
}

/** Nothing is visible any more. */
export function watchNothing(): void {
  clearTimeout(waiting);
  entries?.release();
  entries = null;
  sight();
  sight = () => undefined;
}

// ---- the entries ------------------------------------------------------------------------------------------------------

export function addToWatch(paths: readonly string[], group = ""): void {
  addAll(paths.map((path) => ({ path, group, format: "default" })));
}

/** Ranges of addresses are unfolded at once. */
export function addAll(entries: readonly WatchEntry[]): void {
  editList((content) => addEntries(content, entries));
  const ranges = entries.flatMap(({ path }) => (/:\s*\d+$/.test(path) ? path : []));
  for (const path of ranges) if (!get().open.has(path)) void toggleOpen(path);
  set({ selected: entries.at(-1)?.path ?? null });
}

export function removeFromWatch(root: string): void {
  editList((content) => removeEntry(content, root));
  set(({ notes, drafts }) => ({ notes: without(notes, root), drafts: without(drafts, root), selected: null }));
  told(t("watch.removed", { name: splitPath(root).name }), undoEdit);
}

/** Replaces the name of an entry that was not found. */
export function replaceInWatch(root: string, path: string): void {
  editList((content) => replacePath(content, root, path));
  set({ selected: path });
}

export async function toggleOpen(path: string): Promise<void> {
  const open = new Set(get().open);
  if (open.delete(path)) set({ open });
  else {
    await loadMembers(path);
    set({ open: new Set(get().open).add(path) });
  }
  keepView();
}

export function showMore(path: string): void {
  set(({ shown }) => ({ shown: new Map(shown).set(path, (shown.get(path) ?? PAGE) + 10 * PAGE) }));
}

export function toggleGroup(name: string): void {
  const collapsed = new Set(get().collapsed);
  if (!collapsed.delete(name)) collapsed.add(name);
  set({ collapsed });
  keepView();
}

export function select(path: string | null): void {
  set({ selected: path });
}

// ---- how it is shown --------------------------------------------------------------------------------------------------

/** The format of an entry also applies to its members, unless they have their own. */
export function formatOf(path: string, root: string): Format {
  const own = get().formats.get(path);
  if (own && path !== root) return own;
  return useWatchLists.getState().content.entries.find((entry) => entry.path === root)?.format ?? "default";
}

/** The value of a row, in its format. */
export const shownText = ({ path, root }: { path: string; root: string }) => currentText(path, formatOf(path, root));

export function setFormat(path: string, root: string, format: Format): void {
  if (path === root) {
    editList((content) => withFormat(content, path, format));
    return;
  }
  set(({ formats }) => ({ formats: new Map(formats).set(path, format) }));
  keepView();
}

export function sortBy(column: SortColumn): void {
  set(({ sort }) => ({ sort: nextSort(sort, column) }));
}

export function setFilter(filter: Partial<Filter>): void {
  set((view) => ({
    filter: { ...view.filter, ...filter },
    since: filter.only === "changed" ? changeMark() : view.since,
  }));
}

// ---- writing ----------------------------------------------------------------------------------------------------------

export function setDraft(path: string, text: string): void {
  set(({ drafts, notes }) => ({
    drafts: text === "" ? without(drafts, path) : new Map(drafts).set(path, text),
    notes: without(notes, path),
  }));
}

/** Which call of an in-out's block decides where its writes go; null is the one that ran last. */
export function chooseSite(path: string, site: string | null): void {
  set(({ sites }) => ({ sites: site === null ? without(sites, path) : new Map(sites).set(path, site) }));
}

/** The target of a write if somebody chose a call: for the row itself, or for the in-out that it belongs to. */
const siteOf = (path: string): string => chosenFor(get().sites, path) ?? "";

export async function write(path: string, root: string, value: string): Promise<void> {
  forgetNote(path);
  const answer = await send({ type: "write", path, value: meant(path, root, value), site: siteOf(path) });
  landed("write", path, value, answer);
}

/** Writes the other value of a BOOL whose value is known. */
export async function toggle(row: { path: string; root: string }): Promise<void> {
  const other = { TRUE: "FALSE", FALSE: "TRUE" }[shownText(row)];
  if (other !== undefined) await write(row.path, row.root, other);
}

export async function force(path: string, root: string, value: string): Promise<void> {
  forgetNote(path);
  const answer = await send({ type: "force", path, value: meant(path, root, value), site: siteOf(path) });
  landed("force", path, value, answer);
}

/** A typed value is read in the format of its row. */
function meant(path: string, root: string, value: string): string {
  const symbol = symbolOf(path);
  return symbol ? literalOf(symbol, formatOf(path, root), value) : value;
}

const symbolOf = (path: string) => useWatches.getState().symbols.get(path) ?? memberSymbol(path);

function memberSymbol(path: string) {
  for (const members of useMembers.getState().of.values()) {
    const found = members.find((member) => member.path === path);
    if (found) return found;
  }
  return undefined;
}

export async function releaseForce(path: string | null): Promise<void> {
  const answer = await send({ type: "release", path });
  if (path !== null) landed("force", path, "", answer);
  else if (answer.ok) dismissRefusals();
}

function landed(verb: "write" | "force", path: string, entry: string, answer: Answer): void {
  if (answer.ok) {
    set(({ drafts }) => ({ drafts: drafts.get(path) === entry ? without(drafts, path) : drafts }));
    forgetNote(path);
    dismissRefusals();
    const outside = verb === "write" ? outsideNote(symbolOf(path)?.range ?? "", entry, answer.message) : null;
    if (outside) set(({ notes }) => ({ notes: new Map(notes).set(path, outside) }));
    return;
  }
  const note = noteOf(answer.sent, answer.message, answer.near ?? [], entry, verb);
  set(({ notes }) => ({ notes: new Map(notes).set(path, note) }));
}

function forgetNote(path: string): void {
  set(({ notes }) => ({ notes: without(notes, path) }));
}

/** Removes the message of a refusal after a later action. An entry that was never sent stays. False when there is none. */
export function dismissRefusals(): boolean {
  const { notes } = get();
  const left = new Map([...notes].filter(([, note]) => note.kind !== "refused"));
  if (left.size === notes.size) return false;
  set({ notes: left });
  return true;
}

function without<V>(map: ReadonlyMap<string, V>, key: string): ReadonlyMap<string, V> {
  if (!map.has(key)) return map;
  const next = new Map(map);
  next.delete(key);
  return next;
}
