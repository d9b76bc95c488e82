import { expect, test } from "vitest";
import { columnsOf, movedTo, numberOf, wholeAreas } from "./memory";

test("a row begins with a round number in every notation", () => {
  expect(columnsOf(["D0", "D10"], "hex")).toBe(10);
  expect(columnsOf(["%MW0", "%MW10"], "hex")).toBe(10);
  expect(columnsOf(["W0", "W0A"], "hex")).toBe(8);
  expect(columnsOf(["K4M0", "K4M160"], "hex")).toBe(8);
  expect(columnsOf(["D0", "D10"], "binary")).toBe(5);
  expect(columnsOf([undefined, undefined], "hex")).toBe(8);
});

test("parts of an area that differ in access are one area", () => {
  const part = { description: "", program: "write" };
  expect(
    wholeAreas([
      { ...part, name: "A", words: 448, first: "A0", last: "A447" },
      { ...part, name: "A", words: 512, first: "A448", last: "A959" },
      { ...part, name: "D", words: 100, first: "D0", last: "D99" },
    ]),
  ).toEqual([
    { name: "A", description: "", words: 960, first: "A0", last: "A959" },
    { name: "D", description: "", words: 100, first: "D0", last: "D99" },
  ]);
});

test("keys move by words, rows and pages, and never out of the area", () => {
  const to = (key: string, now: number, ctrl = false) => movedTo(key, ctrl, now, 95, 10, 5);
  expect(to("ArrowRight", 9)).toBe(10);
  expect(to("ArrowLeft", 0)).toBe(0);
  expect(to("ArrowDown", 90)).toBe(90);
  expect(to("ArrowUp", 12)).toBe(2);
  expect(to("PageDown", 60)).toBe(94);
  expect(to("PageUp", 12)).toBe(0);
  expect(to("Home", 37)).toBe(30);
  expect(to("End", 37)).toBe(39);
  expect(to("End", 92)).toBe(94);
  expect(to("End", 3, true)).toBe(94);
  expect(to("a", 3)).toBeUndefined();
});

test("what is typed is a number in the format of the grid, or in the base that it says", () => {
  expect(numberOf("10", "hex", 16)).toBe(16n);
  expect(numberOf("10", "unsigned", 16)).toBe(10n);
  expect(numberOf("-1", "signed", 16)).toBe(65535n);
  expect(numberOf("1234", "bcd", 16)).toBe(0x1234n);
  expect(numberOf("AB", "ascii", 16)).toBe(0x4142n);
  expect(numberOf("16#FF", "unsigned", 16)).toBe(255n);
  expect(numberOf("2#101", "hex", 32)).toBe(5n);
  expect(numberOf("level", "hex", 16)).toBeNull();
  expect(numberOf("16#XY", "hex", 16)).toBeNull();
});
