import { expect, test } from "vitest";
import { next } from "./near";
import { heightOf, Rungs } from "./rungs";

const rung = (body: string, head = "") => `RUNG${head}\n    ${body}\nEND_RUNG\n`;

test("a rung whose text stays is not laid out again, also where it moves", () => {
  const rungs = new Rungs();
  const [first, second] = rungs.of(rung("[a] (b)") + rung("[c] (d)"), 600);
  const again = rungs.of(`// more\n${rung("[x] (y)")}${rung("[a] (b)")}${rung("[c] (e)")}`, 600);
  expect(again[1]?.drawing).toBe(first?.drawing);
  expect(again[1]?.found.line).toBe(5);
  expect(again[2]?.drawing).not.toBe(second?.drawing);
  expect(rungs.of(rung("[a] (b)"), 700)[0]?.drawing?.width).toBe(700);
});

test("a rung that cannot be read keeps its last drawing, and has room for its text", () => {
  const rungs = new Rungs();
  const [before] = rungs.of(rung("[a] (b)"), 600);
  const [broken] = rungs.of(rung("[a (b)"), 600);
  expect(broken?.path).toBeNull();
  expect(broken?.drawing).toBe(before?.drawing);
  expect(broken && before && heightOf(broken) > heightOf(before)).toBe(true);
  expect(new Rungs().of("RUNG\n  [a]\n", 600)[0]).toMatchObject({ path: null, drawing: null });
});

test("arrows go to what is beside an element in the drawing", () => {
  const [drawn] = new Rungs().of(rung("< [a] | [b] > [c] (d)"), 600);
  const drawing = drawn?.drawing;
  if (!drawing) throw new Error("not drawn");
  const names = drawing.elements.map(({ element }) => ("operand" in element ? element.operand : ""));
  const from = (name: string, way: "left" | "right" | "up" | "down") => {
    const at = next(drawing, names.indexOf(name), way);
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
