import { describe, expect, it } from "vitest";
import type { Reaction } from "../../wire/types";
import { nextStep, readersOf, sentenceOf, stretchesOf } from "./reaction";

const reaction = (over: Partial<Reaction>): Reaction => ({
  verdict: "acted",
  basis: "exact",
  carried: [],
  decided_by: [],
  displayed: [],
  unreached: [],
  required: [],
  restarts: [],
  recovery: 0,
  window: 200,
  first_read: 1,
  first_effect: 1,
  readers: [],
  differences: [],
  difference_count: 0,
  lines: [],
  note: "",
  ...over,
});

describe("a reaction", () => {
  it("is described in a sentence, with what to do about a finding", () => {
    expect(sentenceOf(reaction({}), "A402.12")).toBe("after 1 scan.");
    expect(sentenceOf(reaction({ first_effect: 3 }), "A402.12")).toBe("after 3 scans.");
    expect(sentenceOf(reaction({ verdict: "never_read" }), "A402.12")).toContain("A402.12");
    expect(sentenceOf(reaction({ verdict: "no_effect", first_read: 2 }), "A402.12")).toContain("scan 2");
    expect(nextStep("never_read", "A402.12")).toContain("evaluate A402.12");
    for (const verdict of ["no_effect", "stored", "stored_only", "displayed", "not_reached"] as const) {
      expect(nextStep(verdict, "A402.12")).not.toBe("");
    }
    expect(sentenceOf(reaction({ verdict: "stored", first_read: 2 }), "A402.12")).toContain("only stored");
    expect(sentenceOf(reaction({ verdict: "not_reached" }), "A402.12")).toContain("not executed");
    for (const verdict of ["acted", "decided", "reacted", "stopped"] as const)
      expect(nextStep(verdict, "A402.12")).toBe("");
  });

  it("lists each line that read the error once, with everything it read", () => {
    const reader = (line: number, what: "flag" | "code", scan: number) => ({
      file: "A.st",
      pou: "A",
      line,
      what,
      scan,
    });
    const found = readersOf(reaction({ readers: [reader(3, "flag", 2), reader(3, "code", 1), reader(9, "flag", 1)] }));
    expect(found.map(({ line, says }) => [line, says])).toEqual([
      [3, "reads the flag, the code, scan 1"],
      [9, "reads the flag, scan 1"],
    ]);
  });

  it("combines consecutive handler lines", () => {
    const line = (file: string, at: number) => ({ file, line: at });
    const lines = [line("B.st", 4), line("A.st", 8), line("A.st", 7), line("A.st", 12), line("A.st", 12)];
    expect(stretchesOf(reaction({ lines }))).toEqual([
      { file: "A.st", from: 7, to: 8 },
      { file: "A.st", from: 12, to: 12 },
      { file: "B.st", from: 4, to: 4 },
    ]);
  });
});
