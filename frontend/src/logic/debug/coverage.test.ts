import { describe, expect, it } from "vitest";
import type { CoveredSite } from "../../wire/types";
import { coveredAt, linesOf, shareOf } from "./coverage";

const site = (line: number, reached: boolean, outcomes: [string, boolean][] = []): CoveredSite => ({
  line,
  column: 1,
  end_line: line,
  end_column: 9,
  pou: "Main",
  reached,
  outcomes: outcomes.map(([name, taken]) => ({ name, taken })),
});

describe("coverage of lines", () => {
  it("is full, partial or none", () => {
    const looks = linesOf([
      site(3, false),
      site(1, true),
      site(2, true, [
        ["TRUE", true],
        ["FALSE", false],
      ]),
      site(4, true),
      site(4, false),
    ]).map(({ line, look }) => [line, look]);
    expect(looks).toEqual([
      [1, "full"],
      [2, "part"],
      [3, "none"],
      [4, "part"],
    ]);
  });

  it("names the branch that was not taken", () => {
    const [line] = linesOf([
      site(2, true, [
        ["IF", true],
        ["ELSE", false],
      ]),
    ]);
    expect(line?.says).toContain("ELSE");
    expect(line?.says).not.toContain("IF,");
  });

  it("gives the share of statements that were executed", () => {
    expect(shareOf([site(1, true), site(2, false)])).toBe(50);
    expect(shareOf([])).toBeNull();
  });
});

describe("coverage of a place", () => {
  const loop = { ...site(2, true), end_line: 6 };
  const inner = { ...site(4, false), column: 3 };
  const look = (line: number, column: number) =>
    coveredAt([loop, inner, site(8, true)], { line, column })?.look ?? null;

  it("is that of the innermost statement around it", () => {
    expect([look(2, 5), look(4, 5), look(4, 2), look(5, 1), look(7, 1), look(8, 2)]).toEqual([
      "full",
      "none",
      "full",
      "full",
      null,
      "full",
    ]);
  });
});
