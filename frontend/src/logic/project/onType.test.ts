import { expect, test } from "vitest";
import { FinishedLines, finishedBy } from "./onType";

const at = (line: number, column: number, text: string) => ({
  range: { startLineNumber: line, startColumn: column, endLineNumber: line, endColumn: column },
  text,
});
const edit = (line: number) => ({ range: { endLineNumber: line } });

test("Enter, a semicolon at the end of a line, and the last letter of what ends a block finish something", () => {
  const lines = ["", "n := 1;", "  END_IF", "a := 1; b", "bend_if"];
  const textOf = (line: number) => lines[line] ?? "";
  expect(finishedBy([at(1, 8, "\n")], textOf)).toEqual({ ch: "\n", line: 2, column: 1 });
  expect(finishedBy([at(1, 7, ";")], textOf)).toEqual({ ch: ";", line: 1, column: 8 });
  expect(finishedBy([at(2, 8, "F")], textOf)).toEqual({ ch: "F", line: 2, column: 9 });
  for (const [line, column, key] of [
    [2, 3, "E"],
    [3, 7, ";"],
    [4, 7, "f"],
    [1, 1, "n"],
    [1, 2, " "],
  ] as const)
    expect(finishedBy([at(line, column, key)], textOf)).toBeNull();
  expect(finishedBy([at(1, 8, "\n"), at(2, 8, "\n")], textOf)).toBeNull(); // several carets
  expect(finishedBy([at(1, 1, "n := 1;\nm := 2;\n")], textOf)).toBeNull(); // pasted
});

test("an answer about finished lines fits though the next ones are typed meanwhile, and not when they change", () => {
  const lines = new FinishedLines();
  lines.note([at(3, 5, "\n")], 3);
  expect(lines.next()).toBe(3);
  lines.note([at(4, 1, "x")], null);
  expect(lines.fits([edit(2), edit(3)])).toBe(true);
  lines.note([at(4, 2, "\n")], 4);
  expect(lines.fits([edit(3)])).toBe(true);
  expect(lines.fits([edit(4)])).toBe(false);
  expect(lines.next()).toBe(4);
  lines.note([at(4, 1, "y")], null);
  expect(lines.fits([edit(3)])).toBe(true);
  expect(lines.fits([edit(4)])).toBe(false);
});

test("lines that somebody goes back to are not asked about", () => {
  const lines = new FinishedLines();
  lines.note([at(3, 5, "\n")], 3);
  lines.note([at(4, 5, "\n")], 4);
  lines.note([at(4, 1, "x")], null);
  expect([lines.next(), lines.next()]).toEqual([3, undefined]);
});

test("a line is asked about again when what was answered no longer fits because of an edit of our own", () => {
  const lines = new FinishedLines();
  lines.note([at(3, 5, "\n")], 3);
  expect(lines.next()).toBe(3);
  expect(lines.again(3)).toBe(false);
  lines.own([at(2, 1, " ")]);
  expect(lines.fits([edit(3)])).toBe(false);
  expect(lines.again(3)).toBe(true);
  expect(lines.next()).toBe(3);
  expect(lines.fits([edit(3)])).toBe(true);
});
