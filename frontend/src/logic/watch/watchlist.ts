/** The content of a watch list and its edits. Each edit makes new content, so that it can be undone and compared. */
import type { WatchEntry } from "../../wire/types";

export interface ListContent {
  name: string;
  /** Shared with everybody at the project; else private. */
  shared: boolean;
  groups: readonly string[];
  entries: readonly WatchEntry[];
}

const pathsOf = (content: ListContent) => new Set(content.entries.map(({ path }) => path));

/** Adds the entries that the list does not have yet, each at the end of its group. */
export function addEntries(content: ListContent, wanted: readonly WatchEntry[]): ListContent {
  const known = pathsOf(content);
  const fresh: WatchEntry[] = [];
  for (const entry of wanted) {
    if (known.has(entry.path)) continue;
    known.add(entry.path);
    fresh.push(entry);
  }
  const groups = [...new Set([...content.groups, ...fresh.map(({ group }) => group)])].filter((name) => name !== "");
  return { ...content, groups, entries: [...content.entries, ...fresh] };
}

export function removeEntry(content: ListContent, path: string): ListContent {
  return { ...content, entries: content.entries.filter((entry) => entry.path !== path) };
}

/** Replaces a path in its place; if the new path is in the list already, that entry moves here. */
export function replacePath(content: ListContent, path: string, by: string): ListContent {
  const others = content.entries.filter((entry) => entry.path !== by || entry.path === path);
  return { ...content, entries: others.map((entry) => (entry.path === path ? { ...entry, path: by } : entry)) };
}

export function setFormat(content: ListContent, path: string, format: WatchEntry["format"]): ListContent {
  return { ...content, entries: content.entries.map((entry) => (entry.path === path ? { ...entry, format } : entry)) };
}

/** Moves an entry into a group, before a given entry or to the end. */
export function moveEntry(content: ListContent, path: string, group: string, before: string | null): ListContent {
  const moved = content.entries.find((entry) => entry.path === path);
  if (!moved || path === before) return content;
  const entries = content.entries.filter((entry) => entry !== moved);
  const at = before === null ? -1 : entries.findIndex((entry) => entry.path === before);
  entries.splice(at < 0 ? entries.length : at, 0, { ...moved, group });
  return { ...content, entries };
}

export function addGroup(content: ListContent, name: string): ListContent {
  return content.groups.includes(name) ? content : { ...content, groups: [...content.groups, name] };
}

/** A group that is renamed to the name of a different group is merged with it. */
export function renameGroup(content: ListContent, from: string, to: string): ListContent {
  const groups = [...new Set(content.groups.map((name) => (name === from ? to : name)))];
  const entries = content.entries.map((entry) => (entry.group === from ? { ...entry, group: to } : entry));
  return { ...content, groups, entries };
}

/** Its entries stay, without a group. */
export function removeGroup(content: ListContent, name: string): ListContent {
  return {
    ...content,
    groups: content.groups.filter((group) => group !== name),
    entries: content.entries.map((entry) => (entry.group === name ? { ...entry, group: "" } : entry)),
  };
}

/** Two people changed `base`: the result contains what either of them added, removed or changed; of two changes to
 * the same entry it takes mine. */
export function merge(base: ListContent, mine: ListContent, theirs: ListContent): ListContent {
  const groups = mergeOrder(base.groups, mine.groups, theirs.groups);
  const [before, ours, others] = [base, mine, theirs].map(byPath) as [Entries, Entries, Entries];
  const entries = mergeOrder([...before.keys()], [...ours.keys()], [...others.keys()]).flatMap((path) => {
    const own = ours.get(path);
    const changed = own && !same(own, before.get(path));
    return (changed ? own : (others.get(path) ?? own)) ?? [];
  });
  const known = new Set(groups);
  return {
    name: mine.name === base.name ? theirs.name : mine.name,
    shared: mine.shared || theirs.shared,
    groups,
    entries: entries.map((entry) => (entry.group === "" || known.has(entry.group) ? entry : { ...entry, group: "" })),
  };
}

type Entries = Map<string, WatchEntry>;
const byPath = ({ entries }: ListContent): Entries => new Map(entries.map((entry) => [entry.path, entry]));

const same = (one: WatchEntry, other: WatchEntry | undefined) =>
  other !== undefined && one.group === other.group && one.format === other.format;

export function sameContent(one: ListContent, other: ListContent): boolean {
  return (
    one.name === other.name &&
    one.shared === other.shared &&
    one.groups.join("\n") === other.groups.join("\n") &&
    one.entries.length === other.entries.length &&
    one.entries.every((entry, index) => entry.path === other.entries[index]?.path && same(entry, other.entries[index]))
  );
}

/** Their order, unless only mine changed; an entry that I added comes after the same entry as in my list. */
function mergeOrder(base: readonly string[], mine: readonly string[], theirs: readonly string[]): string[] {
  const [inBase, inMine, inTheirs] = [new Set(base), new Set(mine), new Set(theirs)];
  const kept = theirs.filter((key) => inMine.has(key) || !inBase.has(key));
  const common = new Set(kept.filter((key) => inMine.has(key) && inBase.has(key)));
  const ordered = (keys: readonly string[]) => keys.filter((key) => common.has(key));
  const result =
    ordered(theirs).join("\n") === ordered(base).join("\n") ? reordered(kept, common, ordered(mine)) : kept;
  mine.forEach((key, index) => {
    if (inBase.has(key) || inTheirs.has(key)) return;
    const after = mine.slice(0, index).findLast((before) => result.includes(before));
    result.splice(after === undefined ? 0 : result.indexOf(after) + 1, 0, key);
  });
  return result;
}

function reordered(keys: readonly string[], which: ReadonlySet<string>, order: readonly string[]): string[] {
  let next = 0;
  return keys.map((key) => (which.has(key) ? (order[next++] ?? key) : key));
}
