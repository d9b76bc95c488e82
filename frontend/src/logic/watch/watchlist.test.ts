import { describe, expect, it } from "vitest";
import type { WatchEntry } from "../../wire/types";
import {
  addEntries,
  addGroup,
  type ListContent,
  merge,
  moveEntry,
  removeEntry,
  removeGroup,
  renameGroup,
  replacePath,
  sameContent,
  setFormat,
} from "./watchlist";

const entry = (text: string): WatchEntry => {
  const [path = "", group = "", format = "default"] = text.split(";");
  return { path, group, format: format as WatchEntry["format"] };
};
const list = (entries: string, groups = "", name = "L"): ListContent => ({
  name,
  shared: false,
  groups: groups.split(" ").filter(Boolean),
  entries: entries.split(" ").filter(Boolean).map(entry),
});
const shown = ({ entries }: ListContent) =>
  entries.map(({ path, group }) => (group ? `${path};${group}` : path)).join(" ");

describe("a watch list", () => {
  it("takes each path once, and creates the groups of added entries", () => {
    const added = addEntries(list("a b"), [entry("b;x"), entry("c;x"), entry("c"), entry("d")]);
    expect(shown(added)).toBe("a b c;x d");
    expect(added.groups).toEqual(["x"]);
  });

  it("moves entries between groups and places", () => {
    const begin = list("a b;x c;x", "x");
    expect(shown(moveEntry(begin, "a", "x", "c"))).toBe("b;x a;x c;x");
    expect(shown(moveEntry(begin, "b", "", null))).toBe("a c;x b");
    expect(moveEntry(begin, "b", "x", "b")).toBe(begin);
    expect(moveEntry(begin, "nope", "x", null)).toBe(begin);
  });

  it("keeps the entries of a group that is removed or renamed", () => {
    const begin = list("a b;x c;y", "x y");
    expect(shown(removeGroup(begin, "x"))).toBe("a b c;y");
    expect(renameGroup(begin, "x", "y").groups).toEqual(["y"]);
    expect(shown(renameGroup(begin, "x", "y"))).toBe("a b;y c;y");
    expect(addGroup(begin, "x")).toBe(begin);
  });

  it("replaces a path in its place", () => {
    expect(shown(replacePath(list("a b c"), "b", "d"))).toBe("a d c");
    expect(shown(replacePath(list("a b c"), "b", "a"))).toBe("a c");
  });
});

describe("two edits of one list", () => {
  const base = list("a b c d", "g");

  it("contain both additions and both removals", () => {
    const mine = addEntries(removeEntry(base, "a"), [entry("m")]);
    const theirs = addEntries(removeEntry(base, "d"), [entry("t;new")]);
    const merged = merge(base, mine, theirs);
    expect(shown(merged)).toBe("b c m t;new");
    expect(merged.groups).toEqual(["g", "new"]);
  });

  it("take my change of the same entry, and theirs of others", () => {
    const mine = setFormat(base, "a", "hex");
    const theirs = setFormat(setFormat(base, "a", "bcd"), "b", "binary");
    expect(merge(base, mine, theirs).entries.map(({ format }) => format)).toEqual([
      "hex",
      "binary",
      "default",
      "default",
    ]);
  });

  it("keep my order when only I changed it, and theirs when they did", () => {
    const moved = moveEntry(base, "d", "", "a");
    expect(shown(merge(base, moved, addEntries(base, [entry("t")])))).toBe("d a b c t");
    expect(shown(merge(base, addEntries(base, [entry("m")]), moved))).toBe("d m a b c");
  });

  it("keep an entry that I put into a group which somebody removed", () => {
    const mine = moveEntry(base, "a", "g", null);
    expect(shown(merge(base, mine, removeGroup(base, "g")))).toBe("b c d a");
  });

  it("are the same when nobody changed anything", () => {
    expect(sameContent(merge(base, base, base), base)).toBe(true);
    expect(sameContent(base, setFormat(base, "a", "hex"))).toBe(false);
    expect(merge(base, { ...base, name: "mine" }, { ...base, name: "theirs" }).name).toBe("mine");
    expect(merge(base, base, { ...base, name: "theirs" }).name).toBe("theirs");
  });
});
