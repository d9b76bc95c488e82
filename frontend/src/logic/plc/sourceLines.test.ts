import { describe, expect, it } from "vitest";
import type { Pou } from "../../wire/types";
import { isBuilt, lineIn, movedTo, ownerOf, pouAt } from "./sourceLines";

const pous: Pou[] = [
  { name: "FB_Belt", kind: "function_block", file: "belt.st", line: 3 },
  { name: "Main", kind: "program", file: "main.st", line: 1 },
  { name: "FB_Lift", kind: "function_block", file: "belt.st", line: 40 },
];

describe("the declaration of a line", () => {
  it("finds the declaration around a line", () => {
    expect(pouAt(pous, "belt.st", 41)?.name).toBe("FB_Lift");
    expect(pouAt(pous, "belt.st", 10)?.name).toBe("FB_Belt");
    expect(pouAt(pous, "belt.st", 1)).toBeUndefined();
  });

  it("ends a method at its end", () => {
    const block: Pou = { name: "FB", kind: "function_block", file: "fb.st", line: 1 };
    const method: Pou = { name: "FB.run", kind: "method", file: "fb.st", line: 2 };
    const text = "FUNCTION_BLOCK FB\nMETHOD run\n  x := 1;\nEND_METHOD\n  y := 2;\nEND_FUNCTION_BLOCK\n";
    expect(pouAt([block, method], "fb.st", 3, text)?.name).toBe("FB.run");
    expect(pouAt([block, method], "fb.st", 4, text)?.name).toBe("FB.run");
    expect(pouAt([block, method], "fb.st", 5, text)?.name).toBe("FB");
  });

  it("ends an action at its end, and names the variables of its POU there", () => {
    const chart: Pou = { name: "Press", kind: "program", file: "fb.st", line: 1 };
    const action: Pou = { name: "Press.Count", kind: "action", file: "fb.st", line: 2 };
    const text =
      "PROGRAM Press\nACTION Count:\n  n := n + 1;\nEND_ACTION\nTRANSITION FROM A TO B := go; END_TRANSITION\n";
    expect(pouAt([chart, action], "fb.st", 3, text)).toBe(action);
    expect(ownerOf([chart, action], action)).toBe(chart);
    expect(pouAt([chart, action], "fb.st", 5, text)).toBe(chart);
  });
});

describe("the line in a different version of the text", () => {
  const before = "a\nb\nc\nd";
  it("stays the same before an edit and moves after it", () => {
    const after = "a\nnew\nb\nc\nd";
    expect(lineIn(before, after, 1)).toBe(1);
    expect(lineIn(before, after, 2)).toBe(3);
    expect(lineIn(before, after, 4)).toBe(5);
    expect(lineIn(after, before, 5)).toBe(4);
  });
  it("of a deleted line is a line that exists", () => {
    expect(lineIn(before, "a\nd", 2)).toBe(1);
    expect(lineIn(before, "a\nd", 4)).toBe(2);
    expect(lineIn(before, "", 3)).toBe(1);
  });
});

describe("lines of the built text", () => {
  const rung = "RUNG\n  [run] (motor)\nEND_RUNG";
  const built = `PROGRAM Main\n${rung}\nEND_PROGRAM\n`;
  it("are those that moved, too, and not equal ones that nobody has built", () => {
    const twice = `PROGRAM Main\n${rung}\n${rung}\nEND_PROGRAM\n`;
    expect(isBuilt(twice, built, 2, rung)).toBe(true);
    expect(isBuilt(twice, built, 5, rung)).toBe(false);
    expect(isBuilt(built.replace("RUNG", "RUNG // new\n\nRUNG"), built, 4, rung)).toBe(true);
    expect(isBuilt(built.replace("[run]", "[stop]"), built, 2, rung.replace("[run]", "[stop]"))).toBe(false);
  });
});

describe("places of the built text", () => {
  const built = "a := 1;\nb := 2;\nc := 3;";
  const places = [2, 3].map((line) => ({ line, end_line: line }));

  it("move with their lines", () => {
    expect(movedTo(`(* new *)\n${built}`, built, places)).toEqual([3, 4].map((line) => ({ line, end_line: line })));
  });

  it("are left out where the line was edited", () => {
    expect(movedTo(built.replace("b := 2", "b := 5"), built, places)).toEqual([{ line: 3, end_line: 3 }]);
  });
});
