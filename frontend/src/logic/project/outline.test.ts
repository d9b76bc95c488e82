import { expect, test } from "vitest";
import { symbolOf } from "../../testing/symbols";
import { chainAt, declared, keysAt, outlineRows, placeOf, unsectioned } from "./outline";

// 1 FUNCTION_BLOCK Belt / 2 VAR run : BOOL; END_VAR / 3 VAR / 4 speed : INT; / 5 END_VAR / 6 IF run THEN / 7 END_IF / 8 END_FUNCTION_BLOCK
const SYMBOLS = [
  symbolOf("Belt", 5, 1, 8, [
    symbolOf("VAR", 4, 2, 2, [symbolOf("run", 13, 2, 2)]),
    symbolOf("VAR", 4, 3, 5, [symbolOf("speed", 13, 4, 4)]),
    symbolOf("IF run", 25, 6, 7),
  ]),
  symbolOf("Main", 2, 10, 12),
];
const names = (line: number) => chainAt(SYMBOLS, { line, column: 1 }).map(({ symbol }) => symbol.name);

test("what is around the caret: section and variable, statement, POU, nothing between POUs", () => {
  expect([4, 3, 6, 8, 9, 11].map(names)).toEqual([
    ["Belt", "VAR", "speed"],
    ["Belt", "VAR"],
    ["Belt", "IF run"],
    ["Belt"],
    [],
    ["Main"],
  ]);
  expect(chainAt(SYMBOLS, { line: 6, column: 1 })[1]?.siblings.map(({ name }) => name)).toEqual([
    "VAR",
    "VAR",
    "IF run",
  ]);
  expect(placeOf(SYMBOLS[1] as (typeof SYMBOLS)[number])).toEqual({ line: 10, column: 1 });
});

test("the tree has no statements; what is closed hides what is inside; two sections of a name are two", () => {
  const tree = declared(SYMBOLS);
  const rows = (open: (key: string) => boolean, looked = "") =>
    outlineRows(tree, open, looked).map(({ symbol, level, open }) => `${level} ${symbol.name} ${open}`);
  expect(rows(() => false)).toEqual(["0 Belt false", "0 Main undefined"]);
  const around = keysAt(tree, { line: 4, column: 1 });
  expect(rows((key) => around.includes(key))).toEqual([
    "0 Belt true",
    "1 VAR false",
    "1 VAR true",
    "2 speed undefined",
    "0 Main undefined",
  ]);
});

test("for lists of names there are neither statements nor sections", () => {
  expect(unsectioned(SYMBOLS).map(({ children }) => children?.map(({ name }) => name))).toEqual([["run", "speed"], []]);
});

test("while something is looked for, it is shown with what is around it", () => {
  const found = outlineRows(declared(SYMBOLS), () => false, " SPE").map(({ symbol }) => symbol.name);
  expect(found).toEqual(["Belt", "VAR", "speed"]);
  expect(outlineRows(declared(SYMBOLS), () => false, "zzz")).toEqual([]);
});
