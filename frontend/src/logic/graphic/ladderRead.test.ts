import { describe, expect, it } from "vitest";
import { readRung } from "./ladderRead";
import { writeRung } from "./ladderWrite";
import { networksIn } from "./networks";

const BELT = `FUNCTION_BLOCK FB_Belt
VAR_INPUT start, stop : BOOL; END_VAR
RUNG hold: "The motor holds itself"
    // until stop is pressed
    // or a part is stuck
    < [start]
    | [motor]
    > [/stop] [/jam.Q] (motor)
END_RUNG
RUNG "A part is stuck"
    [motor] [/sensor] jam(IN := ~, PT := T#1500ms).Q
    < (S jammed)
    | [P first] parts(CU := ~, R := <[ack] | [auto]>, PV := 3)
    >
END_RUNG
RUNG
    [a] sum := ADD(EN := ~, IN1 := x, IN2 := 1).ENO [n > 3] JMP past
END_RUNG
RUNG past:
    < [a]
      < [b]
      | -> #x
      >
    |
    > #x (/q) RETURN
END_RUNG
END_FUNCTION_BLOCK
`;

describe("rungs", () => {
  it("are found with their heads, lines and comments", () => {
    const found = networksIn(BELT);
    expect(found.map(({ head, line, closed }) => [head.label, head.title, line, closed])).toEqual([
      ["hold", "The motor holds itself", 3, true],
      ["", "A part is stuck", 10, true],
      ["", "", 16, true],
      ["past", "", 19, true],
    ]);
    expect(found[0]?.head.comment).toEqual(["until stop is pressed", "or a part is stuck"]);
    for (const { from, to, text } of found) expect(BELT.slice(from, to)).toBe(text);
  });

  it("are written with the characters they were read from", () => {
    for (const found of networksIn(BELT)) {
      const rung = readRung(found);
      expect(rung.kind).toBe("rung");
      if (rung.kind === "rung") expect(writeRung(rung.head, rung.path, found.indent)).toBe(found.text);
    }
  });

  it("know modes from variables with the same letter", () => {
    const [found] = networksIn(
      "RUNG\n    [P x] [P] [N > 3] [P order] [P NOT x] [P (x OR y)] [P(x)] [P OR x] [/ y] (S q) (S) (P p)\nEND_RUNG\n",
    );
    const rung = found && readRung(found);
    expect(rung?.kind === "rung" && rung.path.map((each) => "mode" in each && [each.mode, each.operand])).toEqual([
      ["P", "x"],
      ["", "P"],
      ["", "N > 3"],
      ["P", "order"],
      ["P", "NOT x"],
      ["P", "(x OR y)"],
      ["", "P(x)"],
      ["", "P OR x"],
      ["/", "y"],
      ["S", "q"],
      ["", "S"],
      ["P", "p"],
    ]);
  });

  it.each([
    ["RUNG\n    [start\nEND_RUNG\n", "close"],
    ["RUNG\n    [a] ? (b)\nEND_RUNG\n", "element"],
    ["RUNG\n    < [a] | [b] (c)\nEND_RUNG\n", "close"],
    ["RUNG\n    [a] (b)\n", "end"],
    ["RUNG\n    [a]] (b)\nEND_RUNG\n", "element"],
  ])("say what is missing: %s", (text, expected) => {
    const [found] = networksIn(text);
    expect(found && readRung(found)).toMatchObject({ kind: "unread", expected });
  });

  it("that are not closed hide no rung after them", () => {
    const found = networksIn("RUNG\n    [a] (b)\nRUNG\n    [c] (d)\nEND_RUNG\nEND_PROGRAM\n");
    expect(found.map(({ line, closed }) => [line, closed])).toEqual([
      [1, false],
      [3, true],
    ]);
  });

  it("are not looked for in comments, strings and statements", () => {
    const text = "rung[3] := 1;\n(*\nRUNG\n*)\nx := 'RUNG';\nRUNG + 1;\n// RUNG\n{off}\nRUNG a: // note\nEND_RUNG\n";
    expect(networksIn(text).map(({ head, line }) => [head.label, head.off, line])).toEqual([["a", true, 9]]);
  });

  it("with a box that is too long have a pin a line", () => {
    const pins = Array.from({ length: 6 }, (_, index) => `        INPUT${index} := machine.station.value${index}`);
    const text = `RUNG\n    [a] box(\n${pins.join(",\n")}).Q (b)\nEND_RUNG`;
    const [found] = networksIn(`${text}\n`);
    const rung = found && readRung(found);
    expect(rung?.kind === "rung" && writeRung(rung.head, rung.path, "")).toBe(text);
  });
});
