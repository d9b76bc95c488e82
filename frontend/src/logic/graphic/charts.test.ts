import { describe, expect, it } from "vitest";
import { partsIn, readChart } from "./charts";

const PRESS = `FUNCTION_BLOCK Press
VAR_INPUT go, up : BOOL; END_VAR
VAR step : INT; END_VAR
INITIAL_STEP Wait:
END_STEP
STEP Stroke:
    down(N);
    lamp(D, T#500ms, lampIsOn);
    Count(P1); // once
    plain;
END_STEP
ACTION Count:
RUNG "inside"
    [up] (x)
END_RUNG
END_ACTION
TRANSITION first (PRIORITY := 2) FROM Wait TO (Stroke, Other) := go AND
    (* really *) NOT up; END_TRANSITION
TRANSITION FROM Stroke TO Wait : RUNG
    [up] [/go]
END_RUNG END_TRANSITION
STEP Other: END_STEP
END_FUNCTION_BLOCK
PROGRAM Main
RUNG
    [a] (b)
END_RUNG
END_PROGRAM
`;

const chartOf = (text: string) => {
  const found = partsIn(text).find(({ kind }) => kind === "chart");
  return found && { found, read: readChart(found) };
};

describe("charts", () => {
  it("are found beside rungs, with the rungs of their actions, without those of their conditions", () => {
    const found = partsIn(PRESS);
    expect(found.map(({ kind, line, closed }) => [kind, line, closed])).toEqual([
      ["chart", 4, true],
      ["rung", 13, true],
      ["rung", 25, true],
    ]);
    expect(found[0]?.text.startsWith("INITIAL_STEP Wait:")).toBe(true);
    expect(found[0]?.text.endsWith("STEP Other: END_STEP")).toBe(true);
  });

  it("have steps with their actions", () => {
    const read = chartOf(PRESS)?.read;
    if (read?.kind !== "chart") throw new Error("not read");
    expect(read.steps.map(({ name, initial }) => [name, initial])).toEqual([
      ["Wait", true],
      ["Stroke", false],
      ["Other", false],
    ]);
    expect(read.steps[1]?.actions.map((each) => [each.action, each.qualifier, each.duration, each.indicator])).toEqual([
      ["down", "N", "", ""],
      ["lamp", "D", "T#500ms", "lampIsOn"],
      ["Count", "P1", "", ""],
      ["plain", "N", "", ""],
    ]);
    expect(read.bodies.map(({ name }) => name)).toEqual(["Count"]);
  });

  it("have transitions, whose condition is an expression or a rung", () => {
    const read = chartOf(PRESS)?.read;
    if (read?.kind !== "chart") throw new Error("not read");
    expect(read.transitions.map(({ name, priority, from, to }) => [name, priority, from, to])).toEqual([
      ["first", 2, ["Wait"], ["Stroke", "Other"]],
      ["", null, ["Stroke"], ["Wait"]],
    ]);
    expect(read.transitions.map(({ condition, rung }) => [condition, rung?.length])).toEqual([
      ["go AND (* really *) NOT up", undefined],
      ["[up] [/go]", 2],
    ]);
  });

  it("know where each part is in the text", () => {
    const chart = chartOf(PRESS);
    if (chart?.read.kind !== "chart") throw new Error("not read");
    const { text } = chart.found;
    const parts = [...chart.read.steps, ...chart.read.transitions, ...chart.read.steps.flatMap((each) => each.actions)];
    expect(parts.map(({ span }) => text.slice(span.at, span.end).split(/[\s;]/)[0])).toEqual([
      ...["INITIAL_STEP", "STEP", "STEP", "TRANSITION", "TRANSITION"],
      ...["down(N)", "lamp(D,", "Count(P1)", "plain"],
    ]);
  });

  it.each([
    ["STEP A:\n  x(N;\nEND_STEP\nEND_PROGRAM", "close"],
    ["STEP A:\n  x(N);\nEND_PROGRAM", "end"],
    ["STEP A:\nEND_STEP\nx := 1;\nSTEP B:\nEND_STEP\nEND_PROGRAM", "element"],
    ["STEP A:\nEND_STEP\nTRANSITION FROM A TO := x; END_TRANSITION\nEND_PROGRAM", "operand"],
    ["STEP A:\nEND_STEP\nTRANSITION FROM A TO B : RUNG\n [a\nEND_RUNG END_TRANSITION\nEND_PROGRAM", "element"],
    ["STEP A:\nEND_STEP\nTRANSITION FROM A TO B := x", "end"],
  ])("say that they cannot be read: %s", (text, expected) => {
    expect(chartOf(text)?.read).toMatchObject({ kind: "unread", expected });
  });

  it("are not looked for where the words are names", () => {
    expect(partsIn("PROGRAM P\nstep := 1;\nstep : INT;\n// STEP A:\ntransition(from := 1);\nEND_PROGRAM")).toEqual([]);
  });
});
