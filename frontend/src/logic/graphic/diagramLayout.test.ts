import { describe, expect, it } from "vitest";
import { type DiagramDrawing, layOutDiagram } from "./diagramLayout";
import { alongWire } from "./diagramPins";
import { readDiagram } from "./diagramRead";
import type { Place, Way } from "./ladderLayout";
import { networksIn } from "./networks";

function drawingOf(lines: readonly string[]): DiagramDrawing {
  const [found] = networksIn(`NETWORK\n${lines.join("\n")}\nEND_NETWORK\n`);
  const read = found && readDiagram(found);
  if (read?.kind !== "network") throw new Error(lines.join("\n"));
  return layOutDiagram(read.items);
}

const DIAGRAMS: Record<string, readonly string[]> = {
  ramp: [
    ...["#twice = MUL(2, step);", "#low = SUB(speed, #twice);", "#high = ADD(speed, step);"],
    ...["speed := LIMIT(MN := #low, IN := target, MX := #high);", "atSpeed := GE(speed, target);"],
  ],
  loop: ["#any = OR(start, #run);", "#run = AND(#any, NOT stop, NOT jam.Q);", "running := #run;"],
  blocks: [
    ...[
      "jam(IN := NOT sensor, PT := T#1500ms, Q => #late);",
      "parts(CU := R_EDGE #late, R := first, PV := 3, CV => n);",
    ],
    ...["jammed S= #late;", "other := NOT #late;", "RETURN IF #late;"],
  ],
  far: [
    ...[
      "#a = f(x);",
      "#b = g(#a);",
      "#c = h(#b);",
      "#d = k(#c, #a, #b);",
      "y := m(#d, #a);",
      "#e = g(#b);",
      "z := m(#e, #a);",
    ],
  ],
  alone: ["x := a;", "f();"],
  empty: [],
};

/** 40 boxes that read wires of any of those before them, by a fixed rule. */
const MANY = Array.from({ length: 40 }, (_value, index) => {
  const reads = [1, 2, 5].map((step, at) => (index - step * (at + 1) >= 0 ? `#w${index - step * (at + 1)}` : `v${at}`));
  return `#w${index} = f${index}(${reads.join(", ")});`;
});

function check({ elements, wires, width, height }: DiagramDrawing): void {
  const wrong: string[] = [];
  const boxes = elements.map((each) => ({
    left: each.x,
    right: each.x + each.width,
    top: each.y - each.up,
    bottom: each.y + each.down,
  }));
  for (const [index, a] of boxes.entries()) {
    expect(a.left).toBeGreaterThanOrEqual(0);
    expect(a.right).toBeLessThanOrEqual(width);
    expect(a.bottom).toBeLessThanOrEqual(height);
    for (const b of boxes.slice(index + 1))
      if (!(a.right <= b.left || b.right <= a.left || a.bottom <= b.top || b.bottom <= a.top))
        wrong.push(`boxes at ${a.left} ${a.top} and ${b.left} ${b.top}`);
  }
  const lines = wires.flatMap(({ wire, points }) =>
    points.slice(1).map(([x, y], index) => {
      const [fromX, fromY] = points[index] ?? [0, 0];
      const [left, right, top, bottom] = [
        Math.min(x, fromX),
        Math.max(x, fromX),
        Math.min(y, fromY),
        Math.max(y, fromY),
      ];
      return { wire, left, right, top, bottom, across: y === fromY };
    }),
  );
  for (const line of lines)
    for (const box of boxes)
      if (line.left < box.right && line.right > box.left && line.top < box.bottom && line.bottom > box.top)
        wrong.push(`${line.wire} in the box at ${box.left} ${box.top}`);
  // Wires cross each other, but never lie on each other.
  for (const [index, a] of lines.entries())
    for (const b of lines.slice(index + 1)) {
      if (a.wire === b.wire || a.across !== b.across) continue;
      const same = a.across ? a.top === b.top : a.left === b.left;
      const overlap = a.across ? a.left < b.right && b.left < a.right : a.top < b.bottom && b.top < a.bottom;
      if (same && overlap) wrong.push(`${a.wire} on ${b.wire}`);
    }
  expect(wrong).toEqual([]); // once: hundreds of thousands of calls take seconds
}

describe("the drawing of a function block diagram", () => {
  it.each(Object.keys(DIAGRAMS))("has nothing over anything else: %s", (name) => {
    const drawing = drawingOf(DIAGRAMS[name] ?? []);
    expect(drawing.elements.length).toBe(DIAGRAMS[name]?.length);
    check(drawing);
  });

  it("has nothing over anything else with 40 boxes", () => check(drawingOf(MANY)));

  it("has nothing over anything else, whatever reads what", () => {
    for (let seed = 1; seed <= 20; seed += 1) {
      const next = randomOf(seed);
      const lines = Array.from({ length: 4 + next(20) }, (_value, index) => {
        const pin = () =>
          index > 0 && next(3) > 0 ? `#w${next(index)}` : next(5) === 0 ? `#w${index + next(3)}` : `v${next(9)}`;
        const pins = Array.from({ length: 1 + next(4) }, pin).join(", ");
        return next(6) === 0 ? `x${index} := ${pin()}; #w${index} = g();` : `#w${index} = f(${pins}, Q => q${index});`;
      });
      check(drawingOf(lines));
    }
  });

  it("leads each wire from its pin to each that reads it", () => {
    const { elements, wires } = drawingOf(DIAGRAMS.far ?? []);
    const ends = wires.filter(({ wire }) => wire === "#A").flatMap(({ points }) => points.map(([x, y]) => `${x} ${y}`));
    const readers = elements.flatMap(({ x, inputs }) =>
      inputs.flatMap(({ pin, y }) => (pin.wire === "#A" ? [`${x} ${y}`] : [])),
    );
    expect(readers).toHaveLength(4);
    for (const each of readers) expect(ends).toContain(each);
  });

  it("draws a wire that is read above its line as a stub, and says of one that nobody sets that it is not connected", () => {
    const from = drawingOf(["#any = OR(start, #run, #gone);", "#run = AND(#any);"]).elements[0]?.inputs.map(
      (each) => each.from,
    );
    expect(from).toEqual(["text", "loop", "nothing"]);
  });

  it("draws a loop through an output that says its type", () => {
    const [item, box] = drawingOf(["n := #count;", "c(CU := up, PV := 3, CV => #count : INT);"]).elements;
    expect(item?.inputs.map(({ from }) => from)).toEqual(["loop"]);
    expect(box?.element.item.outputs.map(({ target, wire, span }) => [target, wire, span.end - span.at])).toEqual([
      ["#count", "#COUNT", 6],
    ]);
  });

  it("moves no box past another when one is put in", () => {
    for (const lines of [...Object.values(DIAGRAMS), MANY.slice(0, 12)])
      for (let at = 0; at <= lines.length; at += 1) {
        const before = drawingOf(lines).elements;
        const more = [...lines.slice(0, at), "#new = fresh(new);", ...lines.slice(at)];
        const after = drawingOf(more).elements.filter((_each, index) => index !== at);
        for (const [i, a] of before.entries())
          for (const [j, b] of before.entries()) {
            const [now, then] = [after[i], after[j]];
            if (!now || !then) continue;
            expect(Math.sign(a.x - b.x)).toBe(Math.sign(now.x - then.x));
            if (a.x === b.x) expect(Math.sign(a.y - b.y)).toBe(Math.sign(now.y - then.y));
          }
      }
  });

  it("is the same at every time", () => {
    expect(drawingOf(MANY)).toEqual(drawingOf(MANY));
  });
});

/** Numbers below a limit, the same ones for a seed at every time. */
function randomOf(seed: number): (limit: number) => number {
  let state = seed * 2_654_435_761;
  return (limit) => {
    state = (Math.imul(state, 1_664_525) + 1_013_904_223) >>> 0;
    return Math.floor((state / 4_294_967_296) * limit);
  };
}

describe("a cursor in a diagram", () => {
  it("goes along wires, and from pin to pin", () => {
    const drawing = drawingOf(["#a = OR(x, y);", "#b = AND(#a, z);", "out := #b;"]);
    const go = (...ways: Way[]) =>
      ways.reduce<Place | null>((place, way) => place && alongWire(drawing, place, way), [0]);
    expect(go("left")).toEqual([0, 0]);
    expect(go("left", "down")).toEqual([0, 1]);
    expect(go("left", "down", "right")).toEqual([0]);
    expect(go("right")).toEqual([0, 2]);
    expect(go("right", "right")).toEqual([1, 0]);
    expect(go("right", "right", "left")).toEqual([0, 2]);
    expect(go("right", "right", "right", "right", "right", "right")).toEqual([2]);
    expect(go("left", "left")).toBeNull();
  });
});
