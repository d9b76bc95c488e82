import { describe, expect, it } from "vitest";
import type { Reaction } from "../../wire/types";
import { basisOf, evidenceOf, placeOf } from "./evidence";

const reaction = (more: Partial<Reaction>): Reaction => ({
  verdict: "stored",
  window: 50,
  first_read: null,
  first_effect: null,
  readers: [],
  differences: [],
  difference_count: 0,
  lines: [],
  note: "",
  basis: "",
  carried: [],
  decided_by: [],
  displayed: [],
  unreached: [],
  required: [],
  restarts: [],
  recovery: 0,
  ...more,
});

const said = (more: Partial<Reaction>) =>
  evidenceOf(reaction(more)).map(({ label, items }) => [
    label,
    ...items.map(({ text, says, readers }) => [text, says, ...readers].filter(Boolean).join(" ")),
  ]);

describe("what a grade is about", () => {
  it("names the words that were reached", () => {
    expect(said({ displayed: ["D100", "Main.shown"] })).toEqual([["Displayed in", "D100", "Main.shown"]]);
  });

  it("names the state that decides later, with who reads it", () => {
    const carried = [{ path: "Main.cnt", scan: 1, readers: ["main.st:4", "main.st:5"] }];
    const [[, item] = []] = said({ carried });
    expect(item).toBe("Main.cnt since scan 1, read at main.st:4 main.st:5");
  });

  it("names what was not reached, and why", () => {
    const one = { file: "main.st", line: 7, paths: ["Main.a", "Main.b"], why: "condition", at: "main.st:6" } as const;
    const task = { file: "slow.st", line: 8, paths: ["Slow"], why: "task", at: "Seldom" } as const;
    const [[, first, second] = []] = said({
      unreached: [
        { ...one, paths: [...one.paths] },
        { ...task, paths: ["Slow"] },
      ],
    });
    expect(first).toBe("main.st:7 (Main.a and 1 more): the condition at main.st:6 was not met");
    expect(second).toBe("slow.st:8 (Slow): task Seldom had no turn");
  });

  it("says whether the runs or the text of the program say so", () => {
    expect(basisOf(reaction({ basis: "exact" }))).toContain("Exact");
    expect(basisOf(reaction({ basis: "static" }))).toContain("Static");
    expect(basisOf(reaction({}))).toBe("");
  });

  it("finds the place of a statement", () => {
    expect(placeOf("plant/main.st:12")).toEqual({ file: "plant/main.st", line: 12 });
    expect(placeOf("D100")).toBeNull();
  });
});
