import { describe, expect, it } from "vitest";
import { readDiagram } from "./diagramRead";
import { networksIn } from "./networks";

const RAMP = `NETWORK "Ramp"
    // no more than a step
    #low = SUB(speed, step); // below
    #high : INT = ADD(speed, step);
    speed := LIMIT(MN := #low, IN := target, MX := #high);
    jam(IN := NOT sensor, PT := T#1500ms, Q => #late, NOT ET => x);
    jammed S= #late;
    parts := SEL(R_EDGE first, parts, ADD(parts, 1));
    a[3] := NOT R_EDGE #late;
    b := (x + 1) * 2;
    belt[1].jam();
    RETURN IF NOT auto;
    JMP past;
END_NETWORK
`;

function itemsOf(text: string) {
  const [found] = networksIn(text);
  const read = found && readDiagram(found);
  if (!found || read?.kind !== "network") throw new Error(JSON.stringify(read));
  return { items: read.items, text: found.text };
}

describe("function block diagrams", () => {
  it("have an item a line, in their order", () => {
    const { items, text } = itemsOf(RAMP);
    expect(
      items.map(({ kind, callee, outputs }) => [kind, callee, outputs.map(({ target }) => target).join()]),
    ).toEqual([
      ["box", "SUB", "#low"],
      ["box", "ADD", "#high"],
      ["box", "LIMIT", "speed"],
      ["box", "jam", "#late,x"],
      ["value", "", "jammed"],
      ["box", "SEL", "parts"],
      ["value", "", "a[3]"],
      ["value", "", "b"],
      ["box", "belt[1].jam", ""],
      ["leave", "", ""],
      ["leave", "", ""],
    ]);
    expect(items.map(({ span }) => text.slice(span.at, span.end).slice(0, 6))).toEqual([
      ...["#low =", "#high ", "speed ", "jam(IN", "jammed", "parts ", "a[3] :", "b := (", "belt[1", "RETURN", "JMP pa"],
    ]);
  });

  it("know where their pins, targets, callees and labels are written", () => {
    const { items, text } = itemsOf(RAMP);
    const at = (span: { at: number; end: number } | null | undefined) => span && text.slice(span.at, span.end);
    expect(items.map(({ named, args }) => [at(named) ?? "", at(args) ?? ""])).toEqual([
      ["SUB", "speed, step"],
      ["ADD", "speed, step"],
      ["LIMIT", "MN := #low, IN := target, MX := #high"],
      ["jam", "IN := NOT sensor, PT := T#1500ms, Q => #late, NOT ET => x"],
      ["", ""],
      ["SEL", "R_EDGE first, parts, ADD(parts, 1)"],
      ["", ""],
      ["", ""],
      ["belt[1].jam", ""],
      ["", ""],
      ["past", ""],
    ]);
    expect(items.flatMap(({ inputs }) => inputs.map(({ span }) => at(span)))).toEqual([
      ...["speed", "step", "speed", "step", "#low", "target", "#high", "NOT sensor", "T#1500ms", "#late"],
      ...["R_EDGE first", "parts", "ADD(parts, 1)", "NOT R_EDGE #late", "(x + 1) * 2", "NOT auto"],
    ]);
    expect(items[3]?.inputs.map(({ arg }) => at(arg))).toEqual(["IN := NOT sensor", "PT := T#1500ms"]);
    expect(items.flatMap(({ outputs }) => outputs.map(({ span, arg }) => [at(span), at(arg) ?? ""]))).toEqual([
      ...[
        ["#low", ""],
        ["#high", ""],
        ["speed", ""],
        ["#late", "Q => #late"],
        ["x", "NOT ET => x"],
        ["jammed", ""],
      ],
      ...[
        ["parts", ""],
        ["a[3]", ""],
        ["b", ""],
      ],
    ]);
  });

  it("have pins that are wires, negated, or look for an edge", () => {
    const { items } = itemsOf(RAMP);
    expect(items[2]?.inputs.map(({ name, text, wire }) => [name, text, wire])).toEqual([
      ["MN", "#low", "#LOW"],
      ["IN", "target", null],
      ["MX", "#high", "#HIGH"],
    ]);
    expect(items[3]?.inputs[0]).toMatchObject({ name: "IN", text: "sensor", negated: true });
    expect(items[3]?.outputs.map(({ name, negated, wire }) => [name, negated, wire])).toEqual([
      ["Q", false, "#LATE"],
      ["ET", true, null],
    ]);
    expect(items[4]?.outputs[0]?.operator).toBe("S");
    expect(items[5]?.inputs.map(({ text, edge }) => [text, edge])).toEqual([
      ["first", "P"],
      ["parts", ""],
      ["ADD(parts, 1)", ""],
    ]);
    expect(items[6]?.inputs[0]).toMatchObject({ text: "#late", negated: true, edge: "P", wire: "#LATE" });
    expect(items[7]?.inputs[0]?.text).toBe("(x + 1) * 2");
    expect([items[9]?.inputs[0]?.text, items[10]?.label]).toEqual(["auto", "past"]);
  });

  it("take a call that goes on as a value", () => {
    const { items } = itemsOf("NETWORK\n x := f(a) + 1;\n y := NOT (a AND b);\n z := AND(a, b);\nEND_NETWORK\n");
    expect(items.map(({ kind, callee }) => [kind, callee])).toEqual([
      ["value", ""],
      ["value", ""],
      ["box", "AND"],
    ]);
  });

  it.each([
    ["NETWORK\n x := f(a\nEND_NETWORK\n", "end"],
    ["NETWORK\n x := f(a)\nEND_NETWORK\n", "end"],
    ["NETWORK\n a;\nEND_NETWORK\n", "item"],
    ["NETWORK\n f(a,);\nEND_NETWORK\n", "operand"],
    ["NETWORK\n x := a;\n", "end"],
  ])("say that they cannot be read: %s", (text, expected) => {
    const [found] = networksIn(text);
    expect(found && readDiagram(found)).toMatchObject({ kind: "unread", expected });
  });
});
