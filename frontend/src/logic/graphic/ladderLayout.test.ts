import { describe, expect, it } from "vitest";
import { InstanceTypes, type TypeOf } from "./instanceTypes";
import { layOut } from "./ladderLayout";
import { readRung } from "./ladderRead";
import { networksIn } from "./networks";
import { powerOf } from "./power";

function drawingOf(body: string, width = 800, typeOf?: TypeOf) {
  const [found] = networksIn(`RUNG\n${body}\nEND_RUNG\n`);
  const rung = found && readRung(found);
  if (rung?.kind !== "rung") throw new Error(body);
  return layOut(rung.path, width, typeOf);
}

/** The operands of the coils that power reaches, and of those it is not known for. */
function reached(body: string, values: Record<string, boolean>) {
  const { nodes, sends, elements } = drawingOf(body);
  const power = powerOf(nodes, sends, (operand) => values[operand] ?? null);
  return elements.flatMap(({ element, before }) =>
    element.kind === "coil" && power[before] !== false ? [power[before] ? element.operand : `${element.operand}?`] : [],
  );
}

const SAMPLES = [
  "[a] (q)",
  "< [a] [b] | [c] [/d] > (q)",
  "[a] < [b] | > < (x) | [c] (y) >",
  "< [a] | [b] < [c] | [/d] > > [x] (q) (S r)",
  "[run] jam(IN := ~, PT := T#30ms, ET => seen).Q (jammed)",
  "< [a] -> #x | [b] > #x (q) JMP out",
  "",
];

describe("the drawing of a rung", () => {
  it.each(SAMPLES)("has coils at the right rail, and nothing over anything else: %s", (body) => {
    const { elements, width, height, rail } = drawingOf(body);
    const boxes = elements.map(({ x, y, width: w, up, down }) => ({
      left: x,
      right: x + w,
      top: y - up,
      bottom: y + down,
    }));
    for (const box of boxes) {
      expect(box.left).toBeGreaterThanOrEqual(rail.left);
      expect(box.right).toBeLessThanOrEqual(rail.right + 0.5);
      expect(box.bottom).toBeLessThanOrEqual(height);
      expect(width).toBe(800);
    }
    for (const [index, a] of boxes.entries())
      for (const b of boxes.slice(index + 1))
        expect(a.right <= b.left || b.right <= a.left || a.bottom <= b.top || b.bottom <= a.top).toBe(true);
  });

  it.each(SAMPLES)("has wires without gaps from the left rail: %s", (body) => {
    const { wires, elements, rail } = drawingOf(body);
    const touches = new Set([String(rail.left)]);
    const ends = wires.map(({ points }) => points.map(([x, y]) => `${x} ${y}`));
    expect(wires.every(({ points }) => points.length === 2)).toBe(true);
    // Each element begins where a wire ends, or at the rail.
    for (const { x, y } of elements)
      expect(touches.has(String(x)) || ends.some((points) => points.includes(`${x} ${y}`))).toBe(true);
  });

  it("becomes wider than the window where it has to", () => {
    const body = Array.from({ length: 20 }, (_, index) => `[contact${index}]`).join(" ");
    expect(drawingOf(`${body} (q)`, 400).width).toBeGreaterThan(1600);
  });

  it("has the type of an instance in its box, and room for how far it is", () => {
    const types = new InstanceTypes(
      "VAR a : BOOL; jam, other : TON; parts : CTU; END_VAR\nVAR jam : Elsewhere; END_VAR",
    );
    const rung = "[a] jam(IN := ~, PT := long, ET => seen).Q MAX(IN1 := a)";
    const [, jam, max] = drawingOf(rung, 800, types.at(40)).elements.map(({ frame }) => frame);
    expect(jam).toMatchObject({ type: "TON", callee: "jam", progress: "jam.ET" });
    expect(max).toMatchObject({ type: "MAX", callee: "MAX", progress: "" });
    expect(types.at(40)("parts")).toBe("CTU");
    expect(types.at(200)("jam")).toBe("Elsewhere");
    expect(types.at(200)("a")).toBeUndefined();
    const down = (typeOf?: TypeOf) => drawingOf(rung, 800, typeOf).elements[1]?.down ?? 0;
    expect(down(types.at(40))).toBeGreaterThan(down());
  });

  it("moves nothing above when a branch is added below", () => {
    const before = drawingOf("< [a] | [b] > (q)").elements.map(({ x, y }) => [x, y]);
    const after = drawingOf("< [a] | [b] | [c] > (q)").elements.map(({ x, y }) => [x, y]);
    for (const place of before) expect(after).toContainEqual(place);
  });
});

describe("power from values", () => {
  it.each<[string, Record<string, boolean>, string[]]>([
    ["[a] (q)", { a: true }, ["q"]],
    ["[/a] (q)", { a: true }, []],
    ["< [a] | [b] > [/c] (q)", { a: false, b: true, c: false }, ["q"]],
    ["< [a] | [b] > [/c] (q)", { a: false, b: true, c: true }, []],
    ["[a] < (x) | [b] (y) >", { a: true, b: false }, ["x"]],
    ["[P a] (q)", { a: true }, ["q?"]],
    ["[off] [P a] (q)", { a: true, off: false }, []],
    ["< [P a] | [b] > (q)", { a: true, b: true }, ["q"]],
    ["[n > 3] (q)", {}, ["q?"]],
    ["[a] jam(IN := ~, PT := T#1s).Q (q)", { a: true, "jam.Q": false }, []],
    ["[a] jam(IN := ~, PT := T#1s) (q)", { a: true }, ["q"]],
    ["[a] x := ADD(EN := ~, IN1 := x, IN2 := 1).ENO (q)", { a: true }, ["q?"]],
    ["< [a] -> #x | [b] > #x (q)", { a: true, b: true }, ["q"]],
    ["< [a] -> #x | [b] > #x (q)", { a: false, b: true }, []],
    ["[a] RETURN", { a: true }, []],
    ["[a] t(EN := ~, IN := b).Q (q)", { a: false, "t.Q": true }, []],
    ["[a] t(EN := ~, IN := b).Q (q)", { a: true, "t.Q": true }, ["q"]],
    ["[P a] t(EN := ~, IN := b).Q (q)", { "t.Q": true }, ["q?"]],
    ["[a] t(EN := < [b] >, IN := ~).Q (q)", { a: true, "t.Q": true }, ["q?"]],
    ["[a] t(EN := b, IN := ~).Q (q)", { a: true, b: false, "t.Q": true }, []],
    ["[a] t(EN := b, IN := ~).ENO (q)", { a: false, b: true }, ["q?"]],
    ["[a] t(IN := ~).Q (q)", { a: false, "t.Q": true }, ["q"]],
  ])("%s", (body, values, wanted) => {
    expect(reached(body, values)).toEqual(wanted);
  });
});
