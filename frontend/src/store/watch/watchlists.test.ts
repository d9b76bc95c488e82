import { beforeEach, describe, expect, it, vi } from "vitest";
import type { WatchList as Told, WatchEntry } from "../../wire/types";

type WatchList = Told & { project: number };

const server = vi.hoisted(() => ({
  lists: new Map<number, unknown>(),
  next: 1,
  /** Holds a save back until the test releases it. */
  held: null as Promise<void> | null,
  fails: false,
}));

vi.mock("../project/documents", () => ({ messageOf: String }));
vi.mock("../../wire/rest", () => {
  class Refused extends Error {}
  type Sent = Omit<WatchList, "id" | "version">;
  const lists = server.lists as Map<number, WatchList>;
  const reach = async () => {
    await server.held;
    if (server.fails) throw new Refused("no room");
  };
  const rest = {
    watchLists: async (project: number) => [...lists.values()].filter((list) => list.project === project),
    watchList: async (id: number) => lists.get(id),
    createWatchList: async (project: number, list: Sent) => {
      await reach();
      const made = { ...list, project, id: server.next, version: 1 } as WatchList;
      server.next += 1;
      lists.set(made.id, made);
      return made;
    },
    saveWatchList: async (id: number, list: Sent, version: number) => {
      await reach();
      const now = lists.get(id) as WatchList;
      if (now.version !== version) return { theirs: now };
      const saved = { ...now, ...list, version: version + 1 } as WatchList;
      lists.set(id, saved);
      return { saved };
    },
    deleteWatchList: async (id: number) => void lists.delete(id),
  };
  return { Refused, rest };
});

const kept = new Map<string, string>();
vi.stubGlobal("localStorage", {
  getItem: (key: string) => kept.get(key) ?? null,
  setItem: (key: string, value: string) => kept.set(key, value),
  removeItem: (key: string) => kept.delete(key),
});

const entry = (path: string): WatchEntry => ({ path, group: "", format: "default" });
const onServer = () =>
  [...(server.lists as Map<number, WatchList>).values()].map(({ project, name, entries }) =>
    [project, name, ...entries.map(({ path }) => path)].join(" "),
  );

/** Runs everything that waits only for its turn. */
const settled = () => new Promise((done) => setTimeout(done));

function hold(): () => Promise<unknown> {
  let let_go = () => {};
  server.held = new Promise((done) => {
    let_go = done;
  });
  return () => {
    server.held = null;
    let_go();
    return settled();
  };
}

let store: typeof import("./watchlists");
const add = (path: string) => store.editList((content) => ({ ...content, entries: [...content.entries, entry(path)] }));
const shown = () => store.useWatchLists.getState().content.entries.map(({ path }) => path);

beforeEach(async () => {
  vi.resetModules();
  server.lists.clear();
  kept.clear();
  Object.assign(server, { next: 1, held: null, fails: false });
  store = await import("./watchlists");
  await store.loadWatchLists(1, []);
});

describe("edits of a watch list", () => {
  it("during the creation of a list, in a project that is left meanwhile, are saved when the project is shown again", async () => {
    const letGo = hold();
    add("a");
    add("b");
    void store.loadWatchLists(2, []);
    await letGo();
    expect(onServer()).toEqual(["1 New list a"]);
    await store.loadWatchLists(1, []);
    await settled();
    expect(shown()).toEqual(["a", "b"]);
    expect(onServer()).toEqual(["1 New list a b"]);
    expect([...kept.keys()].filter((key) => key.includes("unsaved"))).toEqual([]);
  });

  it("during a save are merged with the changes of others", async () => {
    add("a");
    await settled();
    const letGo = hold();
    add("b");
    add("c");
    void store.loadWatchLists(2, []);
    await letGo();
    expect(onServer()).toEqual(["1 New list a b"]);
    const list = server.lists.get(1) as WatchList;
    server.lists.set(1, { ...list, entries: [...list.entries, entry("theirs")], version: list.version + 1 });
    await store.loadWatchLists(1, []);
    await settled();
    expect(onServer()[0]?.split(" ").slice(3).sort()).toEqual(["a", "b", "c", "theirs"]);
  });

  it("are saved at once in the next project, while the save of the previous project is still running", async () => {
    const letGo = hold();
    add("a");
    await store.loadWatchLists(2, []);
    server.held = null;
    add("z");
    await settled();
    expect(onServer()).toEqual(["2 New list z"]);
    await letGo();
    expect(onServer().sort()).toEqual(["1 New list a", "2 New list z"]);
    expect(shown()).toEqual(["z"]);
  });

  it.each(["chooseList", "newList", "duplicateList"] as const)(
    "that could not be saved are not thrown away by %s",
    async (what) => {
      add("a");
      await settled();
      await store.newList();
      add("b");
      await settled();
      server.fails = true;
      add("c");
      await settled();
      await (what === "chooseList" ? store.chooseList(1) : store[what]());
      expect(shown()).toEqual(["b", "c"]);
      expect(store.useWatchLists.getState().trouble).toContain("no room");
      server.fails = false;
      await store.keepAsOwn();
      expect(onServer()).toEqual(["1 New list a", "1 New list 2 b c"]);
      expect(store.useWatchLists.getState().trouble).toBeNull();
    },
  );

  it("while a different list is being fetched are saved first", async () => {
    add("a");
    await settled();
    await store.newList();
    add("b");
    await settled();
    const chosen = store.chooseList(1);
    add("late");
    await chosen;
    await settled();
    expect(shown()).toEqual(["a"]);
    expect(onServer()).toEqual(["1 New list a", "1 New list 2 b late"]);
  });

  it("do not create a list again that is deleted while they are saved", async () => {
    const letGo = hold();
    add("a");
    const deleted = store.deleteList();
    await letGo();
    await deleted;
    expect(onServer()).toEqual([]);
  });
});
