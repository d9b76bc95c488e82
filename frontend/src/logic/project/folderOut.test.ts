import { expect, test } from "vitest";
import { folderHandle } from "../../testing/folderHandle";
import { type FolderPlan, planFor, writeInto } from "./folderOut";

const file = (path: string, text: string) => ({ path, bytes: new TextEncoder().encode(text) });
const FILES = [file("Main.st", "new text"), file("POUs/Deep/Belt.st", "belt"), file("project.json", "{}")];

const paths = ({ fresh, changed, same }: FolderPlan) =>
  [fresh, changed, same].map((list) => list.map(({ path }) => path));

test("a folder is compared file by file before anything is written", async () => {
  const texts = new Map([
    ["Main.st", "old text"],
    ["project.json", "{}"],
    ["notes.txt", "mine"],
  ]);
  const folder = folderHandle(texts);
  const plan = await planFor(folder, FILES);
  expect(paths(plan)).toEqual([["POUs/Deep/Belt.st"], ["Main.st"], ["project.json"]]);
  expect([...texts.values()]).toEqual(["old text", "{}", "mine"]);

  await writeInto(folder, [...plan.fresh, ...plan.changed]);
  expect(Object.fromEntries(texts)).toEqual({
    "Main.st": "new text",
    "notes.txt": "mine",
    "POUs/Deep/Belt.st": "belt",
    "project.json": "{}",
  });
  expect(paths(await planFor(folder, FILES))).toEqual([[], [], ["Main.st", "POUs/Deep/Belt.st", "project.json"]]);
});

test("what the browser refuses is said with the file", async () => {
  const taken = folderHandle(new Map([["Main.st/below.st", ""]]));
  await expect(planFor(taken, FILES)).rejects.toThrow("Main.st: Main.st is a folder");
  const locked = folderHandle(new Map(), { write: false });
  await expect(writeInto(locked, FILES)).rejects.toThrow("Main.st: The folder is read-only");
});
