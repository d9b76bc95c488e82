import { describe, expect, it } from "vitest";
import { copied, networksOf, pasted } from "./clip";
import { namesIn } from "./edit";
import { headEdit } from "./head";
import { Sheet } from "./sheet";

const TEXT = `PROGRAM P
  {off} RUNG hold: "A" // kept
      // one
      < [a] | [b] > (c)
  END_RUNG
  NETWORK
      #w1 = AND(a, b);
      c := #w1;
  END_NETWORK
END_PROGRAM
PROGRAM Q
INITIAL_STEP Init:
    c(N);
END_STEP
TRANSITION FROM Init TO Init := a; END_TRANSITION
END_PROGRAM
`;
const AROUND = { boxes: [], names: namesIn(TEXT) };

function part(index: number) {
  const found = new Sheet().of(TEXT, 600)[index];
  if (!found) throw new Error(String(index));
  return found;
}

/** The text after a paste, or why it was refused. */
function resultOf(index: number, place: readonly number[], text: string): string {
  const made = pasted(part(index), place, text, AROUND);
  return made === null ? "" : "refused" in made ? made.refused : made.text;
}

describe("the clipboard of drawings", () => {
  it("has elements and networks as text", () => {
    expect(copied(part(0), [0])).toBe("< [a] | [b] >");
    expect(copied(part(0), [])).toBe('{off} RUNG hold: "A" // kept\n    // one\n    < [a] | [b] > (c)\nEND_RUNG');
    expect(copied(part(1), [0, 1])).toBe("#w1 = AND(a, b);");
    expect(copied(part(2), [1])).toBe("c(N)");
    expect(copied(part(2), [])).toMatch(/^INITIAL_STEP Init/);
  });

  it("takes networks, and nothing that is none", () => {
    expect(networksOf(TEXT.slice(10, TEXT.indexOf("END_PROGRAM")))).toHaveLength(2);
    for (const text of ["", "x := 1;", "RUNG\n[a\nEND_RUNG", "RUNG\n[a]\n", "RUNG\n(a)\nEND_RUNG x"])
      expect(networksOf(text)).toBeNull();
  });

  it("puts elements after the cursor of a rung", () => {
    expect(resultOf(0, [0], "[x] [/y]")).toContain("> [x] [/y] (c)");
    for (const text of ["", "hello world", "x := 1;", "[a] END_RUNG RUNG [b]"])
      expect(resultOf(0, [0], text)).toBe("graphic.refused.paste");
  });

  it("puts lines into a network, with new names for wires that are set there", () => {
    expect(resultOf(1, [0], "#w1 = OR(a, b);\nd := #w1;")).toContain(
      "#w1 = AND(a, b);\n      #w2 = OR(a, b);\n      d := #w2;\n      c := #w1;",
    );
    expect(resultOf(1, [0], "[a] (b)")).toBe("graphic.refused.paste");
  });

  it("puts actions and steps into a chart", () => {
    expect(resultOf(2, [0], "lamp(S)")).toContain("c(N);\n    lamp(S);\n");
    const made = resultOf(2, [0], "STEP Init:\n    c(N);\nEND_STEP");
    expect(made).toContain("STEP Init1:\n    c(N);\nEND_STEP");
    expect(made).toContain("TRANSITION FROM Init TO Init1");
    expect(resultOf(2, [0], "TRANSITION FROM Init TO Init := a; END_TRANSITION")).toBe("graphic.refused.paste");
  });
});

describe("the head of a network", () => {
  const named = (index: number, key: string, typed: string) => {
    const made = headEdit(part(index).found, key, []);
    return made && "naming" in made ? made.naming?.taken(typed, AROUND)?.text : undefined;
  };

  it("is named, and the rest of the text stays", () => {
    expect(named(0, "l", "again")).toContain('RUNG again: "A" // kept\n      // one\n      < [a]');
    expect(named(0, "t", 'say "x"')).toContain('hold: "say $"x$"" // kept');
    expect(named(0, ";", "one // two")).toContain("// one\n      // two\n      < [a]");
    expect(named(1, "T", "Sum")).toContain('NETWORK "Sum"\n      #w1');
    expect(named(1, "l", "2 x")).toBeUndefined();
  });
});
