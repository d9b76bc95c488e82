import { describe, expect, it } from "vitest";
import type { Flow, FlowElement } from "../../wire/types";
import { apartIn } from "./apart";
import { partFlow } from "./flow";
import { elementIn } from "./places";
import { Sheet } from "./sheet";

const TEXT = `PROGRAM Main
RUNG
    [a] [/b] t(IN := ~, PT := pt).Q (c)
END_RUNG
NETWORK
    #sum = ADD(x, 3);
    y := MUL(#sum, x);
END_NETWORK
INITIAL_STEP Idle:
END_STEP
STEP Run:
END_STEP
TRANSITION FROM Idle TO Run := a;
END_TRANSITION
END_PROGRAM
`;
const COLUMNS = (TEXT.split("\n")[2] ?? "").split("").flatMap((each, at) => ("[t(".includes(each) ? [at + 1] : []));
const [A = 0, B = 0, BOX = 0] = COLUMNS;
const C = (TEXT.split("\n")[2] ?? "").lastIndexOf("(c)") + 1;

type Values = Record<string, string>;

/** Written: with an equals sign after its name: `c=`. */
const element = (line: number, column: number, power: boolean | null, values: Values = {}): FlowElement => ({
  ...{ line, column, power, runs: 1 },
  values: Object.entries(values).map(([name, text]) => ({
    name: name.replace("=", ""),
    text,
    written: name.endsWith("="),
  })),
});

const flow = (elements: FlowElement[], wires: Values = {}): Flow => ({
  ...{ scan: 7, calls: 1, call: 1, whole: true, elements },
  wires: Object.entries(wires).map(([name, text]) => ({ name, text, line: 6 })),
});

function apart(index: number, one: Flow, other: Flow, first?: [number, number]) {
  const part = new Sheet().of(TEXT, 900)[index];
  if (!part) throw new Error("no part");
  const [a, b] = [one, other].map((each) => partFlow(part, [each], (line) => line));
  if (!a || !b) throw new Error("no flow");
  return apartIn(part, [a, b], first ? elementIn(part, { line: first[0], column: first[1] }) : null);
}

const said = ({ marks }: ReturnType<typeof apart>) =>
  marks.map(({ name, control, monitor, power, first }) => [name, control, monitor, power, first]);

describe("where two sides of a verification part", () => {
  const control = flow([
    element(3, A, true, { a: "TRUE" }),
    element(3, B, true, { b: "FALSE" }),
    element(3, BOX, true, { "t.IN=": "TRUE", "t.running": "TRUE", "t.Q": "TRUE", "t.PT": "T#1s" }),
    element(3, C, null, { "c=": "TRUE" }),
  ]);
  const monitor = flow([
    element(3, A, true, { a: "TRUE" }),
    element(3, B, false, { b: "TRUE" }),
    element(3, BOX, false, { "t.IN=": "FALSE", "t.running": "FALSE", "t.Q": "FALSE" }),
    element(3, C, null, { "c=": "FALSE" }),
  ]);

  it("is told at contacts, pins, coils and wires of a rung, and the first one is the cause", () => {
    const found = apart(0, control, monitor, [3, B]);
    expect(said(found)).toEqual([
      ["", "FALSE", "TRUE", false, true], // The contact, of which the drawing has the name.
      ["", "TRUE", "FALSE", false, false], // Pin IN; what differs inside of the timer is not drawn.
      ["", "TRUE", "FALSE", false, false], // Pin Q.
      ["", "TRUE", "FALSE", false, false],
      ["", "1", "0", true, false], // Two wires have power on one side only.
      ["", "1", "0", true, false],
    ]);
    expect(found.wires).toBe("2A 3A");
  });

  it("is nowhere where both are the same", () => {
    expect(apart(0, control, control)).toEqual({ marks: [], wires: "" });
  });

  it("is told of what ran on one side only", () => {
    const short = flow([element(3, A, true, { a: "TRUE" })]);
    expect(said(apart(0, control, short)).slice(0, 1)).toEqual([["", "FALSE", null, false, false]]);
  });

  it("is told at the pins and wires of a network", () => {
    const one = flow([element(6, 5, null, { x: "1" }), element(7, 5, null, { x: "1", "y=": "4" })], { "#SUM": "4" });
    const other = flow([element(6, 5, null, { x: "2" }), element(7, 5, null, { x: "2", "y=": "10" })], { "#SUM": "5" });
    const found = apart(1, one, other, [6, 5]);
    expect(found.marks.map(({ key, control, monitor, first }) => [key, control, monitor, first])).toEqual([
      ["0.0", "1", "2", true],
      ["0.2", "4", "5", false],
      ["1.1", "1", "2", false],
      ["1.2", "4", "10", false],
    ]);
    expect(found.wires).toBe("#SUMX");
  });

  it("is told of steps that are active on one side only", () => {
    const found = apart(2, flow([element(9, 1, null)]), flow([element(11, 1, null)]));
    expect(found.marks.map(({ key, name, control, monitor }) => [key, name, control, monitor])).toEqual([
      ["0", "X", "TRUE", "FALSE"],
      ["1", "X", "FALSE", "TRUE"],
    ]);
  });
});
