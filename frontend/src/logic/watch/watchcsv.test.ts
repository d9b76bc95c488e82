import { describe, expect, it } from "vitest";
import type { WatchEntry } from "../../wire/types";
import { fromCsv, toCsv } from "./watchcsv";

const entries: WatchEntry[] = [
  { path: "Main.belt[1,2].run", format: "default", group: "" },
  { path: "W10:8", format: "hex", group: 'Belt; "3"' },
];

describe("a watch list as CSV", () => {
  it("is read back as it was written", () => {
    expect(toCsv(entries)).toBe('path;format;group\r\nMain.belt[1,2].run;default;\r\nW10:8;hex;"Belt; ""3"""\r\n');
    expect(fromCsv(toCsv(entries))).toEqual({ entries, bad: [] });
    expect(fromCsv(`\uFEFF${toCsv(entries)}`).entries).toEqual(entries);
  });

  it("is also read from other programs: with different separators and orders, or only paths", () => {
    expect(fromCsv('Group,Path\n"a,b","Main.x[1,2]"').entries).toEqual([
      { path: "Main.x[1,2]", format: "default", group: "a,b" },
    ]);
    expect(fromCsv("Main.a\nMain.b\n\n").entries.map(({ path }) => path)).toEqual(["Main.a", "Main.b"]);
    expect(fromCsv("Main.a;HEX;g").entries).toEqual([{ path: "Main.a", format: "hex", group: "g" }]);
  });

  it("says which lines are wrong, and why", () => {
    const { entries: good, bad } = fromCsv(`path;format;group\nD1;octal;\n;hex;\nD2;hex;\nD3;hex;${"x".repeat(101)}`);
    expect(good.map(({ path }) => path)).toEqual(["D2"]);
    expect(bad).toEqual([
      expect.stringMatching(/^Line 2: .*octal.*hex/),
      expect.stringMatching(/^Line 3: .*path/),
      expect.stringMatching(/^Line 5: .*group/),
    ]);
  });

  it("contains no formula for a spreadsheet, and is read back without the guard", () => {
    const groups = ["=1+1", "+x", "-x", "@SUM(A1)", "'=kept", "''@", "'plain", "a=b"];
    const listed = groups.map((group): WatchEntry => ({ path: "D1", format: "default", group }));
    const text = toCsv(listed);
    for (const line of text.split("\r\n").slice(1, -1)) expect(line.split(";")[2]).not.toMatch(/^[=+\-@]/);
    expect(text).toContain("D1;default;'=1+1\r\n");
    expect(fromCsv(text)).toEqual({ entries: listed, bad: [] });
  });

  it("reads cells with line breaks, and numbers the lines after them correctly", () => {
    const listed: WatchEntry[] = [{ path: "D1", format: "hex", group: "two\r\nlines" }];
    expect(fromCsv(toCsv(listed))).toEqual({ entries: listed, bad: [] });
    expect(fromCsv(`${toCsv(listed)}D2;octal;`).bad).toEqual([expect.stringMatching(/^Line 4: /)]);
  });

  it("loses one line, not all, to an unclosed quote", () => {
    const { entries: good, bad } = fromCsv('path;format;group\nD1;hex;"open\nD2;hex;\nD3;hex;g');
    expect(good.map(({ path }) => path)).toEqual(["D2", "D3"]);
    expect(bad).toEqual([expect.stringMatching(/^Line 2: .*quot/)]);
  });
});
