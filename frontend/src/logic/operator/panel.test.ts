import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { expect, test } from "vitest";
import {
  addElement,
  changeElement,
  EMPTY_PANEL,
  mergePanels,
  type Panel,
  parsePanel,
  removeElement,
  SIZES,
  textOf,
} from "./panel";

type New = Parameters<typeof addElement>[1];
const add = (panel: Panel, element: New) => addElement(panel, element, 24);
test("a meaning is kept with the element; one that is not known is none", () => {
  const lamp = (tone: string) =>
    `{"version":1,"elements":[{"id":"a","kind":"lamp","column":0,"row":0,"width":4,"height":2,"tone":"${tone}"}]}`;
  const tones = ["fault", "normal", "purple"].map((tone) => {
    const read = parsePanel(lamp(tone));
    if (!("elements" in read)) throw new Error(read.why);
    return parsePanel(textOf(read));
  });
  expect(tones.map((read) => "elements" in read && read.elements[0]?.tone)).toEqual(["fault", undefined, undefined]);
});

const two = add(add(EMPTY_PANEL, { id: "a", kind: "lamp", path: "motor" }), { id: "b", kind: "slider", path: "speed" });

const placeOf = (panel: Panel, id: string) => {
  const { column, row, width, height } = panel.elements.find((element) => element.id === id) as Panel["elements"][0];
  return [column, row, width, height];
};

test("a panel is the same after it was written and read", () => {
  expect(parsePanel(textOf(two))).toEqual(two);
  expect(parsePanel(textOf(EMPTY_PANEL))).toEqual(EMPTY_PANEL);
});

test("a new element takes the first free place, or the cell where it was dropped", () => {
  expect(placeOf(two, "a")).toEqual([0, 0, 4, 2]);
  expect(placeOf(two, "b")).toEqual([4, 0, 7, 2]);
  const dropped = add(two, { id: "c", kind: "text", at: { column: 10, row: 7 } });
  expect(placeOf(dropped, "c")).toEqual([10, 7, 5, 1]);
  expect(placeOf(addElement(two, { id: "c", kind: "trend" }, 14), "c")).toEqual([0, 2, 9, 5]);
});

test("an element stays on the grid and keeps its smallest size", () => {
  expect(placeOf(changeElement(two, "b", { column: -3, width: 1, height: 0 }), "b")).toEqual([0, 0, 4, 2]);
  expect(placeOf(changeElement(two, "a", { column: 1000 }), "a")[0]).toBe(60 - SIZES.lamp[0]);
});

test("whatever is made can be read again", () => {
  const long = changeElement(two, "a", { label: "x".repeat(600) });
  expect(parsePanel(textOf(long))).toEqual(long);
  let full = two;
  for (let number = 0; number < 600; number += 1)
    full = add(full, { id: `n${number}`, kind: "lamp", at: { column: 0, row: 0 } });
  expect(parsePanel(textOf(full))).toEqual(full);
});

test("of two people who changed a panel both are kept", () => {
  const mine = changeElement(removeElement(two, "a"), "b", { label: "Speed" });
  const theirs = add(changeElement(two, "b", { high: 50 }), { id: "c", kind: "text" });
  const merged = mergePanels(two, mine, theirs);
  expect(merged.elements.map(({ id, label }) => [id, label])).toEqual([
    ["b", "Speed"],
    ["c", ""],
  ]);
  expect(mergePanels(two, two, theirs)).toEqual(theirs);
  expect(mergePanels(two, mine, two)).toEqual(mine);
  const changed = changeElement(two, "a", { label: "A" });
  expect(mergePanels(two, changed, removeElement(two, "a")).elements.map(({ id }) => id)).toEqual(["b", "a"]);
});

test("what is wrong with a text is said with its place", () => {
  const first = '{"version":1,"elements":[{"id":"a","kind":"lamp","column":0,"row":0,"width":2,"height":2}';
  expect(parsePanel("{")).toEqual({ why: "json", at: 0 });
  expect(parsePanel("null")).toEqual({ why: "version", at: 0 });
  expect(parsePanel('{"version":2,"elements":[]}')).toEqual({ why: "version", at: 0 });
  expect(parsePanel('{"version":1}')).toEqual({ why: "elements", at: 0 });
  for (const second of ['{"id":"b","kind":"dial"}', '{"id":"a","kind":"lamp"}', "3", "null"])
    expect(parsePanel(`${first},${second}]}`)).toEqual({ why: "element", at: 2 });
  expect(parsePanel(`${first}]}`)).toEqual({
    elements: [
      { id: "a", kind: "lamp", path: "", label: "", low: 0, high: 100, column: 0, row: 0, width: 2, height: 2 },
    ],
  });
});

const GOLDEN = join(import.meta.dirname, "golden");

test.each(readdirSync(GOLDEN))("a panel that was written earlier is read: %s", (name) => {
  const panel = parsePanel(readFileSync(join(GOLDEN, name), "utf8"));
  expect(panel).toHaveProperty("elements");
  expect("elements" in panel && panel.elements.map(({ kind, path, high }) => [kind, path, high])).toEqual([
    ["button", "start", 100],
    ["button", "stop", 100],
    ["button", "reset", 100],
    ["lamp", "motor", 100],
    ["lamp", "lamp", 100],
    ["number", "partsTotal", 100],
    ["bar", "bufferLevel", 40],
    ["slider", "bufferLevel", 40],
    ["trend", "bufferLevel", 40],
  ]);
});
