import { describe, expect, it } from "vitest";
import type { Chart } from "./chart";
import { type ChartDrawing, layOutChart } from "./chartLayout";
import { partsIn, readChart } from "./charts";

/** A chart from lines such as `A -> B, C: condition`; the first step is the initial one. */
function textOf(lines: readonly string[]): string {
  const names = lines.flatMap((line) => line.split(":")[0]?.split(/->|,/) ?? []).map((name) => name.trim());
  const steps = [...new Set(names)].map(
    (name, index) => `${index === 0 ? "INITIAL_" : ""}STEP ${name}:\n  act${name}(N);\nEND_STEP\n`,
  );
  const list = (text = "") => (text.includes(",") ? `(${text.trim()})` : text.trim());
  const transitions = lines.map((line) => {
    const [path = "", condition = "x"] = line.split(":");
    const [from, to] = path.split("->");
    return `TRANSITION FROM ${list(from)} TO ${list(to)} := ${condition.trim()}; END_TRANSITION\n`;
  });
  return `PROGRAM P\n${steps.join("")}${transitions.join("")}END_PROGRAM\n`;
}

function chartOf(text: string): Chart {
  const [found] = partsIn(text);
  const read = found && readChart(found);
  if (read?.kind !== "chart") throw new Error(text);
  return read;
}

const CHARTS: Record<string, readonly string[]> = {
  loop: ["A -> B", "B -> A"],
  alternatives: ["A -> B", "A -> C", "B -> D", "C -> D", "D -> A"],
  simultaneous: ["Idle -> Fill, Heat", "Fill -> Filled", "Heat -> Warm", "Filled, Warm -> Mix", "Mix -> Idle"],
  batch: [
    ...["Idle -> Fill, Heat", "Fill -> Filled", "Heat -> Warm", "Filled, Warm -> Mix", "Mix -> Drain: Mix.T >= T#3s"],
    ...["Mix -> Reject", "Drain -> Idle", "Reject -> Idle"],
  ],
  skip: ["A -> B", "A -> C", "B -> C", "C -> A"],
  nested: ["A -> B", "A -> C", "B -> D", "B -> E", "D -> F", "E -> F", "C -> G", "F -> G", "G -> A"],
  crossing: ["A -> B", "A -> C", "A -> D", "B -> M", "C -> N", "D -> M", "M -> N", "N -> A"],
  tangled: ["A -> B, C", "B -> D", "C -> D", "D -> C", "B, D -> A", "D -> E, B", "E -> E"],
  alone: ["A -> A"],
};

function check(drawing: ChartDrawing): void {
  const boxes = drawing.elements.map((each) => ({
    left: each.x,
    right: each.x + each.width,
    top: each.y - each.up,
    bottom: each.y + each.down,
    ...each,
  }));
  const wrong: string[] = [];
  for (const box of boxes) {
    expect(box.left).toBeGreaterThanOrEqual(0);
    expect(box.top).toBeGreaterThanOrEqual(0);
    expect(box.right).toBeLessThanOrEqual(drawing.width);
    expect(box.bottom).toBeLessThanOrEqual(drawing.height);
  }
  for (const [index, a] of boxes.entries()) {
    for (const b of boxes.slice(index + 1))
      if (!(a.right <= b.left || b.right <= a.left || a.bottom <= b.top || b.bottom <= a.top))
        wrong.push(`boxes at ${a.left} ${a.top} and ${b.left} ${b.top}`);
    // No line goes through a step or an action, and none across the text of a transition.
    for (const { points } of drawing.lines) {
      const [[x1, y1], [x2, y2]] = points as [[number, number], [number, number]];
      const [left, right, top, bottom] = [Math.min(x1, x2), Math.max(x1, x2), Math.min(y1, y2), Math.max(y1, y2)];
      const inside = left < a.right - 1 && right > a.left + 1 && top < a.bottom - 1 && bottom > a.top + 1;
      if (inside && !(a.element.kind === "transition" && left === right && left === a.axis))
        wrong.push(`line from ${x1} ${y1} to ${x2} ${y2} in the box at ${a.left} ${a.top}`);
    }
  }
  expect(wrong).toEqual([]); // once: so many calls take seconds
}

describe("the drawing of a chart", () => {
  it.each(Object.keys(CHARTS))("has every step and transition once, and nothing over anything else: %s", (name) => {
    const chart = chartOf(textOf(CHARTS[name] ?? []));
    const drawing = layOutChart(chart);
    const wanted = chart.steps.length + chart.transitions.length + chart.steps.flatMap(({ actions }) => actions).length;
    expect(drawing.elements.length).toBe(wanted);
    expect(new Set(drawing.elements.map(({ element }) => element)).size).toBe(wanted);
    check(drawing);
  });

  it("goes back by arrows, and forward by lines that meet", () => {
    const arrowsOf = (name: string) => layOutChart(chartOf(textOf(CHARTS[name] ?? []))).arrows.map((each) => each.name);
    expect(arrowsOf("loop")).toEqual(["A"]);
    expect(arrowsOf("alternatives")).toEqual(["A"]);
    expect(arrowsOf("batch")).toEqual(["Idle", "Idle"]);
    expect(arrowsOf("nested")).toEqual(["A"]);
    // The line of C would cross the one from B to M.
    expect(arrowsOf("crossing")).toContain("N");
  });

  it("has double lines where sequences begin and end together", () => {
    const doubles = (name: string) =>
      layOutChart(chartOf(textOf(CHARTS[name] ?? []))).lines.filter(({ double }) => double).length;
    expect([doubles("alternatives"), doubles("simultaneous")]).toEqual([0, 2]);
  });

  it("numbers alternatives in the order in which they are tested", () => {
    const text = textOf(["A -> B", "A -> C"]).replace(
      "TRANSITION FROM A TO C",
      "TRANSITION (PRIORITY := 1) FROM A TO C",
    );
    const orders = layOutChart(chartOf(text)).elements.flatMap(({ element, order }) =>
      element.kind === "transition" ? [[element.to[0], order]] : [],
    );
    expect(orders).toEqual([
      ["B", 2],
      ["C", 1],
    ]);
  });

  it("says where a step is not known", () => {
    const text = textOf(["A -> B"]).replace("STEP B:\n  actB(N);\nEND_STEP\n", "");
    expect(layOutChart(chartOf(text)).arrows).toMatchObject([{ name: "B", unknown: true }]);
  });

  it("moves no element past another when a step is put in", () => {
    for (const lines of Object.values(CHARTS).slice(0, 5))
      for (const [index, line] of lines.entries()) {
        const [from, to] = line.split(":")[0]?.split("->") ?? [];
        const more = [...lines.slice(0, index), `${from} -> New`, `New -> ${to}`, ...lines.slice(index + 1)];
        // The names stay in the order of the first chart.
        const before = placesOf(textOf(lines));
        const after = placesOf(textOf([...lines, ...more].slice(lines.length)));
        for (const [a, one] of before)
          for (const [b, other] of before) {
            const [now, then] = [after.get(a), after.get(b)];
            if (!now || !then) continue;
            expect(Math.sign(one.x - other.x) * Math.sign(now.x - then.x), `${line}: ${a} ${b}`).toBeGreaterThanOrEqual(
              0,
            );
            if (one.x === other.x) expect(Math.sign(one.y - other.y)).toBe(Math.sign(now.y - then.y));
          }
      }
  });

  it("has nothing over anything else, whatever follows what", () => {
    for (let seed = 50; seed < 80; seed += 1) {
      const next = randomOf(seed);
      const names = Array.from({ length: 3 + next(9) }, (_value, index) => `S${index}`);
      const some = () => [
        ...new Set(Array.from({ length: next(4) === 0 ? 2 + next(2) : 1 }, () => names[next(names.length)])),
      ];
      const more = Array.from({ length: names.length + next(6) }, () => `${some().join(", ")} -> ${some().join(", ")}`);
      const chart = chartOf(textOf([`${names.join(", ")} -> S0`, ...more].slice(next(2))));
      const drawing = layOutChart(chart);
      const wanted = chart.steps.length + chart.transitions.length + chart.steps.flatMap((each) => each.actions).length;
      expect(new Set(drawing.elements.map(({ element }) => element)).size, `seed ${seed}`).toBe(wanted);
      expect(drawing.elements.length, `seed ${seed}`).toBe(wanted);
      check(drawing);
    }
  });

  it("draws a chart of 300 steps", () => {
    const lines = Array.from({ length: 300 }, (_, index) => `S${index} -> S${(index + 1) % 300}`);
    const drawing = layOutChart(chartOf(textOf(lines)));
    expect(drawing.elements.length).toBe(900);
    expect(drawing.arrows.length).toBe(1);
  });
});

function placesOf(text: string): Map<string, { x: number; y: number }> {
  return new Map(
    layOutChart(chartOf(text)).elements.flatMap(({ element, axis, y }) =>
      element.kind === "step" ? [[element.name, { x: axis, y }] as const] : [],
    ),
  );
}

/** Numbers below a limit, the same ones for a seed at every time. */
function randomOf(seed: number): (limit: number) => number {
  let state = seed * 2_654_435_761;
  return (limit) => {
    state = (Math.imul(state, 1_664_525) + 1_013_904_223) >>> 0;
    return Math.floor((state / 4_294_967_296) * limit);
  };
}
