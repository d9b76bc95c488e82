import { expect, test } from "vitest";
import { next } from "./near";
import { elementIn, inText } from "./places";
import { actionOf, type DrawnRung, heightOf, placeOnWire, Sheet, stepIn } from "./sheet";

const rung = (body: string, head = "") => `RUNG${head}\n    ${body}\nEND_RUNG\n`;

test("a rung whose text stays is not laid out again, also where it moves", () => {
  const rungs = new Sheet();
  const [first, second] = rungs.of(rung("[a] (b)") + rung("[c] (d)"), 600);
  const again = rungs.of(`// more\n${rung("[x] (y)")}${rung("[a] (b)")}${rung("[c] (e)")}`, 600);
  expect(again[1]?.drawing).toBe(first?.drawing);
  expect(again[1]?.found.line).toBe(5);
  expect(again[2]?.drawing).not.toBe(second?.drawing);
  expect(rungs.of(rung("[a] (b)"), 700)[0]?.drawing?.width).toBe(700);
});

test("a rung that cannot be read keeps its last drawing, and has room for its text", () => {
  const rungs = new Sheet();
  const [before] = rungs.of(rung("[a] (b)"), 600);
  const [broken] = rungs.of(rung("[a (b)"), 600);
  expect(broken?.readable).toBe(false);
  expect(broken?.drawing).toBe(before?.drawing);
  expect(broken && before && heightOf(broken, 28) > heightOf(before, 28)).toBe(true);
  expect(new Sheet().of("RUNG\n  [a]\n", 600)[0]).toMatchObject({ path: null, drawing: null });
});

test("arrows go to what is beside an element in the drawing", () => {
  const [drawn] = new Sheet().of(rung("< [a] | [b] > [c] (d)"), 600);
  const drawing = drawn?.drawing;
  if (!drawing) throw new Error("not drawn");
  const names = (drawing as NonNullable<DrawnRung["drawing"]>).elements.map(({ element }) =>
    "operand" in element ? element.operand : "",
  );
  const from = (name: string, way: "left" | "right" | "up" | "down") => {
    const at = next(drawing.elements, names.indexOf(name), way);
    return at === null ? null : names[at];
  };
  expect([from("a", "down"), from("b", "up"), from("a", "right"), from("b", "right")]).toEqual(["b", "a", "c", "c"]);
  expect([from("c", "right"), from("d", "left"), from("a", "left"), from("d", "right")]).toEqual([
    "d",
    "c",
    null,
    null,
  ]);
});

const CHART = `PROGRAM P
  INITIAL_STEP A:
    Count(P1);
  END_STEP
  ACTION Count:
    n := n + 1;
  END_ACTION
  TRANSITION FROM A TO A := go; END_TRANSITION
END_PROGRAM
`;

test("a chart that cannot be read keeps its last drawing, too", () => {
  const sheet = new Sheet();
  const [before] = sheet.of(CHART, 600);
  const [broken] = sheet.of(CHART.replace("P1)", "P1"), 600);
  expect([broken?.kind, broken?.readable]).toEqual(["chart", false]);
  expect(broken?.drawing).toBe(before?.drawing);
});

test("a place in the text of a chart is that of its innermost element; statements of an action are its first use", () => {
  const [chart] = new Sheet().of(CHART, 600);
  if (chart?.kind !== "chart") throw new Error("not drawn");
  const at = (line: number, column: number) => {
    const place = elementIn(chart, { line, column });
    const found = chart.drawing?.elements.find((each) => each.place === place)?.element;
    return found && (found.kind === "action" ? found.action : found.kind);
  };
  expect([at(2, 3), at(3, 5), at(3, 9), at(6, 5), at(8, 3)]).toEqual(["step", "Count", "Count", "Count", "transition"]);
  expect(inText(chart, chart.drawing?.elements[1]?.element.span.at ?? 0)).toEqual({ line: 3, column: 5 });
  expect(at(9, 1)).toBeUndefined();
  expect([stepIn(chart, "a"), stepIn(chart, "b")]).toEqual([[0], undefined]);
});

test("a rung of an action knows its chart", () => {
  const parts = new Sheet().of(CHART.replace("n := n + 1;", "RUNG\n[a] (b)\nEND_RUNG") + rung("[a] (b)"), 600);
  expect(parts.map((part) => actionOf(parts, part)?.name)).toEqual([undefined, "Count", undefined]);
});

test("a click at a wire means the place after what is to its left", () => {
  const [part] = new Sheet().of(rung("< [a] | [b] > [c] (d)"), 600);
  if (part?.kind !== "rung" || !part.drawing) throw new Error("not drawn");
  const [a, b, c, d] = part.drawing.elements;
  const on = (x: number, y = c?.y ?? 0) => placeOnWire(part, x, y);
  expect(on((c?.x ?? 0) + 1)).toEqual([0]);
  expect(on((d?.x ?? 0) - 30)).toEqual([1]);
  expect(on((a?.x ?? 0) + 2)).toEqual([0, 0]);
  expect(on((b?.x ?? 0) + 70, b?.y)).toEqual([0, 1, 0]);
  expect(on(300, 500)).toBeNull();
});
