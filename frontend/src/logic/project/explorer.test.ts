import { describe, expect, it } from "vitest";
import type { Pou } from "../../wire/types";
import { newFilePath, placeFor, pouGroups, shownAt } from "./explorer";

const pous: Pou[] = [
  { name: "FB_Belt", kind: "function_block", file: "belt.st", line: 3 },
  { name: "Main", kind: "program", file: "main.st", line: 1 },
  { name: "FB_Lift", kind: "function_block", file: "belt.st", line: 40 },
];

describe("explorer", () => {
  it("groups by kind in the standard's order and keeps files without declarations", () => {
    const groups = pouGroups(pous, [
      { path: "main.st", version: 1, author: "Mika" },
      { path: "broken.st", version: 2, author: "Mika" },
    ]);
    expect(groups.map((group) => [group.kind, group.nodes.map((node) => node.name)])).toEqual([
      ["program", ["Main"]],
      ["function_block", ["FB_Belt", "FB_Lift"]],
      ["file", ["broken.st"]],
    ]);
    expect(groups[1]?.nodes[0]).toMatchObject({ shared: true });
  });

  it("shows a method or property that has a file of its own by that file", () => {
    const members: Pou[] = [
      { name: "FB_Belt", kind: "function_block", file: "FB_Belt.st", line: 1 },
      { name: "FB_Belt.Run", kind: "method", file: "FB_Belt.Run.st", line: 1 },
      { name: "FB_Belt.Stop", kind: "method", file: "FB_Belt.st", line: 9 },
    ];
    const files = ["FB_Belt.st", "FB_Belt.Run.st"].map((path) => ({ path, version: 1, author: "Mika" }));
    expect(pouGroups(members, files).map((group) => [group.kind, group.nodes.map((node) => node.name)])).toEqual([
      ["function_block", ["FB_Belt"]],
      ["file", ["FB_Belt.Run.st"]],
    ]);
  });

  it("shows global variables by their files", () => {
    const globals: Pou[] = [
      { name: "start", kind: "global", file: "Globals.st", line: 2 },
      { name: "stop", kind: "global", file: "Globals.st", line: 3 },
    ];
    expect(pouGroups(globals, [])).toEqual([
      { kind: "global", nodes: [{ kind: "pou", name: "Globals.st", file: "Globals.st", line: 2, shared: false }] },
    ]);
  });

  it("shows the plant by its files, apart from the program", () => {
    const tank: Pou = { name: "Tank", kind: "program", file: "plant/tank.st", line: 1 };
    const files = ["plant/inputs.csv", "plant/tank.st"].map((path) => ({ path, version: 1, author: "Mika" }));
    expect(pouGroups([tank], files)).toEqual([
      {
        kind: "plant",
        nodes: [
          { kind: "file", name: "inputs.csv", file: "plant/inputs.csv" },
          { kind: "file", name: "tank.st", file: "plant/tank.st" },
        ],
      },
    ]);
  });

  it("shows a library by its file, not by all that it declares", () => {
    const timer: Pou = { name: "TON", kind: "function_block", file: "libraries/Tc2_Standard.st", line: 1 };
    const file = { path: "libraries/Tc2_Standard.st", version: 1, author: "Mika" };
    expect(pouGroups([timer], [file])).toEqual([
      { kind: "library", nodes: [{ kind: "file", name: "Tc2_Standard", file: file.path }] },
    ]);
  });

  it("shows the block around the cursor, not its method", () => {
    const method: Pou = { name: "FB_Belt.run", kind: "method", file: "belt.st", line: 8 };
    expect(shownAt([...pous, method], "belt.st", 9)?.name).toBe("FB_Belt");
  });

  it("makes paths for new files", () => {
    expect(newFilePath(" FB_New ", [])).toBe("FB_New.st");
    expect(newFilePath("a.ST", [])).toBe("a.ST");
    expect(newFilePath("FB_X.TcPOU", [])).toBe("FB_X.TcPOU");
    expect(newFilePath("main", [{ path: "Main.st", version: 1, author: "Mika" }])).toBeNull();
    expect(newFilePath("../x", [])).toBeNull();
    expect(newFilePath("plant/", [])).toBeNull();
    expect(newFilePath("plant/tank", [])).toBe("plant/tank.st");
    expect(newFilePath("inputs.csv", [])).toBe("plant/inputs.csv");
    expect(newFilePath("inputs.csv", [{ path: "plant/inputs.csv", version: 1, author: "Mika" }])).toBeNull();
    expect(placeFor("plant/inputs.csv")).toBe("plant/inputs.csv");
    expect(placeFor("Main.st")).toBe("Main.st");
  });
});
