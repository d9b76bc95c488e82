import { describe, expect, it } from "vitest";
import { matches, pattern, replaced, replacement, type Wanted } from "./search";

const PLAIN: Wanted = { text: "", cased: false, whole: false, regex: false };
const TEXT = "motor := Motor1;\n  IF motor THEN\n    n := n + 1; // motor.\nEND_IF;\n";

const found = (wanted: Partial<Wanted>, text = TEXT) => {
  const looked = pattern({ ...PLAIN, ...wanted });
  return looked ? matches(text, looked).map(({ line, column, groups }) => `${line}:${column} ${groups[0]}`) : null;
};

describe("search in a text", () => {
  it("tells line and column of each place", () => {
    expect(found({ text: "motor" })).toEqual(["1:1 motor", "1:10 Motor", "2:6 motor", "3:20 motor"]);
    expect(found({ text: "motor", cased: true })).toEqual(["1:1 motor", "2:6 motor", "3:20 motor"]);
    expect(found({ text: "motor", whole: true })).toEqual(["1:1 motor", "2:6 motor", "3:20 motor"]);
  });

  it("takes signs as they are, unless it is an expression", () => {
    expect(found({ text: "n + 1" })).toEqual(["3:10 n + 1"]);
    expect(found({ text: "^\\s*(IF|END_IF)", regex: true })).toEqual(["2:1   IF", "4:1 END_IF"]);
    expect(found({ text: "(", regex: true })).toBeNull();
    expect(found({ text: "x*", regex: true })).toEqual([]);
  });

  it("knows words of all languages", () => {
    expect(found({ text: "量", whole: true }, "量 := 流量;")).toEqual(["1:1 量"]);
  });

  it("finds what goes over several lines", () => {
    expect(found({ text: "THEN\\n\\s+n", regex: true })).toEqual(["2:12 THEN\n    n"]);
  });
});

describe("replacing", () => {
  const replace = (wanted: Partial<Wanted>, by: string) => {
    const full = { ...PLAIN, ...wanted };
    const looked = pattern(full) ?? /$^/;
    return replaced(TEXT, matches(TEXT, looked), (match) => replacement(match, by, full.regex));
  };

  it("changes only what was found", () => {
    expect(replace({ text: "motor", whole: true }, "belt")).toBe(
      "belt := Motor1;\n  IF belt THEN\n    n := n + 1; // belt.\nEND_IF;\n",
    );
    expect(replace({ text: "n + 1" }, "$1")).toContain("n := $1;");
  });

  it("puts groups of an expression in", () => {
    expect(replace({ text: "(\\w+) := (\\w+)", regex: true }, "$2 := $1")).toContain("Motor1 := motor;\n");
    expect(replace({ text: "(?<=IF )motor", regex: true }, "($&) $$1")).toContain("IF (motor) $1 THEN");
  });
});
