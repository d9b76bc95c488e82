import { describe, expect, it } from "vitest";
import type { PlcSymbol } from "../../wire/types";
import { actualOf, noteOf, PAGE, pathsToWatch, type WatchListView, watchRows } from "./watchrows";

const symbol = (path: string, more: Partial<PlcSymbol> = {}) =>
  ({ path, name: path, expandable: false, type: "INT", address: null, section: "VAR", ...more }) as PlcSymbol;
const entry = (path: string, group = "") => ({ path, group, format: "default" as const });

const view: WatchListView = {
  entries: [entry("Main.belt"), entry("Main.b", "Belt 2"), entry("A402"), entry("Main.a", "Belt 2")],
  groups: ["Belt 1", "Belt 2"],
  collapsed: new Set(),
  open: new Set(["Main.belt", "Main.belt[1]"]),
  shown: new Map(),
  members: new Map([
    ["Main.belt", [symbol("Main.belt[1]", { expandable: true }), symbol("Main.belt[2]", { expandable: true })]],
    ["Main.belt[1]", [symbol("Main.belt[1].run")]],
  ]),
  symbols: new Map([
    ["Main.belt", symbol("Main.belt", { expandable: true })],
    ["Main.a", symbol("Main.a", { type: "BOOL", address: "D100" })],
  ]),
  notes: new Map([["A402", noteOf(true, "A402 is read-only", [], "1", "write")]]),
  refusals: new Map(),
  sort: null,
  filter: { text: "", only: "all" },
  keyOf: (path) => ({ "Main.b": 3, A402: 20 })[path] ?? null,
  isForced: (path) => path === "Main.a",
  hasChanged: (path) => path === "A402",
};
const shown = (of: Partial<WatchListView>) =>
  watchRows({ ...view, ...of }).map((row) =>
    row.kind === "group" ? `# ${row.name} ${row.count}` : `${row.kind} ${row.path}`,
  );

describe("watchRows", () => {
  it("lists entries without a group first, then the groups; members are below their owner, notes below their row", () => {
    expect(shown({})).toEqual([
      "value Main.belt",
      "value Main.belt[1]",
      "value Main.belt[1].run",
      "value Main.belt[2]",
      "value A402",
      "note A402",
      "# Belt 1 0",
      "# Belt 2 2",
      "value Main.b",
      "value Main.a",
    ]);
  });

  it("folds groups, and sorts inside them", () => {
    const folded = shown({ collapsed: new Set(["Belt 2"]), open: new Set(), notes: new Map() });
    expect(folded.slice(-2)).toEqual(["# Belt 1 0", "# Belt 2 2"]);
    const byName = shown({ open: new Set(), notes: new Map(), sort: { column: "target", down: false } });
    expect(byName).toEqual([
      "value A402",
      "value Main.belt",
      "# Belt 1 0",
      "# Belt 2 2",
      "value Main.a",
      "value Main.b",
    ]);
    const byValue = shown({ open: new Set(), notes: new Map(), sort: { column: "current", down: true } });
    expect(byValue.slice(0, 2)).toEqual(["value A402", "value Main.belt"]);
  });

  it("filters by text in paths, types, addresses and unfolded members, and by state", () => {
    const of = (text: string, only: "all" | "forced" | "changed" | "errors" = "all") =>
      shown({ filter: { text, only } }).filter((row) => !row.startsWith("value Main.belt["));
    expect(of("bool")).toEqual(["# Belt 2 1", "value Main.a"]);
    expect(of("d100")).toEqual(["# Belt 2 1", "value Main.a"]);
    expect(of(".run")).toEqual(["value Main.belt"]);
    expect(of("", "forced")).toEqual(["# Belt 2 1", "value Main.a"]);
    expect(of("", "changed")).toEqual(["value A402", "note A402"]);
    expect(of("", "errors")).toEqual(["value A402", "note A402"]);
  });

  it("shows a large array page by page", () => {
    const members = new Map([["Main.v", Array.from({ length: 250 }, (_, i) => symbol(`Main.v[${i}]`))]]);
    const large = { ...view, entries: [entry("Main.v")], groups: [], open: new Set(["Main.v"]), members };
    const first = watchRows(large);
    expect(first).toHaveLength(PAGE + 2);
    expect(first.at(-1)).toMatchObject({ kind: "more", path: "Main.v", shown: PAGE, total: 250 });
    expect(watchRows({ ...large, shown: new Map([["Main.v", 250]]) })).toHaveLength(251);
  });

  it("says where an in-out leads, and knows the rows below it", () => {
    const zone = symbol("Main.fb.zone", { expandable: true, section: "VAR_IN_OUT", in_out: true });
    const rows = watchRows({
      ...view,
      entries: [entry("Main.fb.zone")],
      groups: [],
      open: new Set(["Main.fb.zone"]),
      symbols: new Map([["Main.fb.zone", zone]]),
      members: new Map([["Main.fb.zone", [symbol("Main.fb.zone.parts")]]]),
    });
    expect(rows.map(({ kind }) => kind)).toEqual(["value", "binding", "value"]);
    expect(rows[2]).toMatchObject({ inOut: "Main.fb.zone" });
    expect(actualOf("Main.fb.zone.parts", "Main.fb.zone", "Main.zone[3]")).toBe("Main.zone[3].parts");
  });

  it("reports an unknown name, and what it may have meant", () => {
    const refusals = new Map([["Main.belt", { message: "no such variable", near: ["Main.belts"] }]]);
    const rows = watchRows({ ...view, open: new Set(), refusals });
    expect(rows[1]).toMatchObject({ kind: "note", note: { kind: "unknown", near: ["Main.belts"] } });
  });

  it("watches entries and visible values, but not the structures among them", () => {
    expect(pathsToWatch(watchRows(view))).toEqual(["Main.belt", "Main.belt[1].run", "A402", "Main.b", "Main.a"]);
  });

  it("offers an allowed value instead of a refused one", () => {
    expect(noteOf(true, "Main.x: 1800 is outside of INT (0 to 1500)", [], "1800", "write").instead).toEqual(["1500"]);
    expect(noteOf(false, "", [], "1800", "force")).toMatchObject({ kind: "unsent", instead: [] });
  });
});
