import { expect, test } from "vitest";
import { folderEntry } from "../../testing/folder";
import { filesIn } from "./droppedFolder";

test("files of a folder and those below it are found with their folders; what a project has no use for is left out", async () => {
  const folder = folderEntry("Line", {
    "Main.st": "PROGRAM Main END_PROGRAM",
    "readme.txt": "x",
    ".git": { config: "x" },
    POUs: { "Belt.TcPOU": "<x/>", Deep: { "inputs.csv": "time; a" } },
    panels: { "Line.panel.json": "{}", "package.json": "{}" },
    "locked.st": new Error("no"),
    "huge.st": "x".repeat(8_000_001),
    Empty: {},
  });
  const { files, left } = await filesIn([folder, folderEntry("Other", { "B.st": "" })]);
  expect(files.map(({ path }) => path)).toEqual([
    "Line/Main.st",
    "Line/panels/Line.panel.json",
    "Line/POUs/Belt.TcPOU",
    "Line/POUs/Deep/inputs.csv",
    "Other/B.st",
  ]);
  expect(left.map(({ path, why }) => `${path} ${why}`)).toEqual([
    "Line/.git hidden",
    "Line/huge.st size",
    "Line/locked.st unreadable",
    "Line/panels/package.json kind",
    "Line/readme.txt kind",
  ]);
});
