import { describe, expect, it } from "vitest";
import type { Flow, FlowElement } from "../../wire/types";
import { partFlow, seenPower, valueIn } from "./flow";
import { Sheet } from "./sheet";

const TEXT = `PROGRAM Main
RUNG
    < [a]
    | [b]
    > [/c] t(IN := ~, PT := T#1s).Q (d) (e)
END_RUNG
RUNG
    < [d] -> #x | [b] > #x (f)
END_RUNG
END_PROGRAM
`;

const element = (line: number, column: number, power: boolean | null, values: Record<string, string> = {}) =>
  ({
    ...{ line, column, power, runs: 1 },
    values: Object.entries(values).map(([name, text]) => ({ name, text, written: false })),
  }) satisfies FlowElement;

const flow = (scan: number, elements: FlowElement[], more: Partial<Flow> = {}): Flow => ({
  ...{ scan, calls: 1, call: 1, whole: true, wires: [] },
  ...more,
  elements,
});

const FIRST = [
  element(3, 7, false, { a: "FALSE" }),
  element(4, 7, true, { b: "TRUE" }),
  element(5, 7, true, { c: "FALSE" }),
  element(5, 12, false, { "t.Q": "FALSE" }),
  element(5, 37, null, { d: "FALSE" }),
  element(5, 41, null, { e: "FALSE" }),
];

function rung(index: number) {
  const part = new Sheet().of(TEXT, 800)[index];
  if (part?.kind !== "rung" || !part.drawing) throw new Error("no rung");
  return { part, drawing: part.drawing };
}

const same = (line: number) => line;

describe("the flow through a rung", () => {
  it("has the power that was noted, and joins branches by themselves", () => {
    const { part, drawing } = rung(0);
    const found = partFlow(part, [flow(7, FIRST)], same);
    expect(found).toMatchObject({ state: "ran", scan: 7 });
    if (!found) return;
    const power = seenPower(drawing, found);
    expect(drawing.nodes.map(({ kind }, index) => [kind, power[index]?.power])).toEqual([
      ["rail", true],
      ["contact", false],
      ["contact", true],
      ["join", true],
      ["join", true],
      ["contact", true],
      ["box", false],
    ]);
    const coil = drawing.elements.find(({ element }) => element.kind === "coil");
    expect(valueIn(found.at.get(coil?.place.join(".") ?? ""), "D")).toBe("FALSE");
  });

  it("gives a link the power that was sent", () => {
    const { part, drawing } = rung(1);
    const ran = [
      element(8, 7, true),
      element(8, 11, null),
      element(8, 19, true),
      element(8, 25, true),
      element(8, 28, null),
    ];
    const found = partFlow(part, [flow(7, ran)], same);
    const power = found ? seenPower(drawing, found) : [];
    const receive = drawing.nodes.findIndex(({ kind }) => kind === "receive");
    expect(power[receive]).toEqual({ power: true, stale: false });
  });

  it("shows the scan before from where a scan is halted", () => {
    const { part, drawing } = rung(0);
    const halted = flow(8, FIRST.slice(0, 3), { whole: false });
    const found = partFlow(part, [halted, flow(7, FIRST)], same);
    expect(found).toMatchObject({ state: "begun", scan: 8 });
    const power = found ? seenPower(drawing, found) : [];
    expect(power.map(({ stale }) => stale)).toEqual([false, false, false, false, false, false, true]);
    const later = partFlow(rung(1).part, [halted, flow(7, [element(8, 7, false)])], same);
    expect(later).toMatchObject({ state: "last", scan: 7 });
  });

  it("says what did not run, and what was not called", () => {
    const { part, drawing } = rung(1);
    const jumped = partFlow(part, [flow(7, FIRST)], same);
    expect(jumped?.state).toBe("skipped");
    expect(jumped && seenPower(drawing, jumped).some(({ power }) => power)).toBe(false);
    expect(partFlow(part, [flow(7, [], { calls: 0, call: 0 })], same)?.state).toBe("uncalled");
    expect(partFlow(part, [], same)).toBeNull();
  });
});
