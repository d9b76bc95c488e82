import { beforeEach, expect, test, vi } from "vitest";
import { addElement, changeElement, EMPTY_PANEL, type Panel, parsePanel, textOf } from "../../logic/operator/panel";

const PATH = "Belt.panel.json";
const server = vi.hoisted(() => ({ text: "", version: 1, fails: false }));

const documents = vi.hoisted(() => ({
  now: { project: 1, files: [] as { path: string }[] },
  heard: (_now: object, _before: object) => {},
}));

vi.mock("../project/documents", () => ({
  useDocuments: {
    getState: () => documents.now,
    subscribe: (heard: typeof documents.heard) => {
      documents.heard = heard;
    },
  },
  createFile: vi.fn(),
}));
vi.mock("../../wire/rest", () => ({
  rest: {
    file: async () => ({ path: "Belt.panel.json", ...server }),
    save: async (_project: number, path: string, text: string, version: number) => {
      if (server.fails) throw new Error("no room");
      if (version !== server.version) return { conflict: { message: "", theirs: { path, ...server } } };
      server.text = text;
      server.version += 1;
      return { saved: { path, version: server.version } };
    },
  },
}));

const kept = new Map<string, string>();
vi.stubGlobal("localStorage", {
  getItem: (key: string) => kept.get(key) ?? null,
  setItem: (key: string, value: string) => kept.set(key, value),
  removeItem: (key: string) => kept.delete(key),
});

const { editPanel, onPanelSaved, openPanel, undoPanelEdit, useOperatorPanels } = await import("./panels");

/** Runs everything that waits only for its turn. */
const settled = () => new Promise((done) => setTimeout(done));
const add = (id: string) => (panel: Panel) => addElement(panel, { id, kind: "lamp" }, 24);
const ids = (panel: Panel | undefined) => panel?.elements.map(({ id, label }) => id + label).join(" ");
const shown = () => useOperatorPanels.getState().open[PATH];
const stored = () => ids(parsePanel(server.text) as Panel);

/** The list of files as it is from now on. */
function filesAre(...paths: string[]): void {
  const before = documents.now;
  documents.now = { project: 1, files: paths.map((path) => ({ path })) };
  documents.heard(documents.now, before);
}

/** Somebody else saves. */
function theySave(change: (panel: Panel) => Panel): void {
  server.text = textOf(change(parsePanel(server.text) as Panel));
  server.version += 1;
}

beforeEach(async () => {
  Object.assign(server, { text: textOf(add("a")(EMPTY_PANEL)), version: 1, fails: false });
  kept.clear();
  filesAre();
  filesAre(PATH);
  await openPanel(PATH);
});

test("a change is saved at once, and is taken back", async () => {
  editPanel(PATH, add("b"));
  editPanel(PATH, add("c"));
  await settled();
  expect(stored()).toBe("a b c");
  undoPanelEdit(PATH);
  await settled();
  expect(stored()).toBe("a b");
  expect(kept.size).toBe(0);
});

test("of two people who change a panel at once, both changes stay", async () => {
  theySave(add("theirs"));
  editPanel(PATH, (panel) => changeElement(panel, "a", { label: "!" }));
  await settled();
  expect(stored()).toBe("a! theirs");
  expect(ids(shown()?.panel)).toBe("a! theirs");
  theySave(add("later"));
  await onPanelSaved({ path: PATH, version: server.version, author: "Jo" });
  expect(ids(shown()?.panel)).toBe("a! theirs later");
  undoPanelEdit(PATH);
  await settled();
  expect(stored()).toBe("a theirs later");
});

test("what could not be saved is kept in the browser, and saved at the next visit", async () => {
  server.fails = true;
  editPanel(PATH, add("b"));
  await settled();
  expect(shown()?.trouble).toBe("no room");
  useOperatorPanels.setState({ open: {} }); // the page is loaded again
  server.fails = false;
  theySave(add("theirs"));
  await openPanel(PATH);
  await settled();
  expect(stored()).toBe("a theirs b");
  expect(shown()?.trouble).toBeNull();
});

test("a text that is no panel is shown as that, and never overwritten", async () => {
  const good = server.text;
  server.text = "{";
  server.version += 1;
  await onPanelSaved({ path: PATH, version: server.version, author: "Jo" });
  expect(shown()?.wrong).toEqual({ why: "json", at: 0 });
  editPanel(PATH, add("b"));
  await settled();
  expect(server.text).toBe("{");
  server.text = textOf(changeElement(parsePanel(good) as Panel, "a", { label: " repaired" }));
  server.version += 1;
  await onPanelSaved({ path: PATH, version: server.version, author: "Jo" });
  expect(ids(shown()?.panel)).toBe("a repaired");
});

test("a panel that was deleted is not shown, and comes back as what it is then", async () => {
  filesAre();
  expect(shown()).toBeUndefined();
  server.text = textOf(EMPTY_PANEL);
  server.version = 1;
  filesAre(PATH);
  await openPanel(PATH);
  expect(ids(shown()?.panel)).toBe("");
});
