import { expect, test } from "vitest";
import { headingOf } from "./heading";

test("a short comment is beside its title", () => {
  expect(headingOf("Ramp", ["slowly"], 600)).toEqual({
    title: ["Ramp"],
    beside: true,
    comment: ["slowly"],
    height: 28,
  });
});

test("a comment that has no room there is below it, whole, and so is a title that is too long for one line", () => {
  const title = "Analog unit: the flow is not measured, so that nobody knows how much is in the bottle";
  const made = headingOf(title, ["The valve shuts at once, or the bottle would run over.", "It is lost."], 360);
  expect(made.title.length).toBeGreaterThan(1);
  expect(made.title.join(" ")).toBe(title);
  expect(made.comment.join(" ")).toBe("The valve shuts at once, or the bottle would run over. It is lost.");
  expect(made.height).toBe(28 + 18 * (made.title.length - 1 + made.comment.length));
});

test("lines of a comment stay lines, and words without blanks are divided", () => {
  expect(headingOf("A title of its own", ["first", "second line"], 150).comment).toEqual(["first", "second line"]);
  const japanese = "流量を測定できないため充填を停止してください".repeat(3);
  const made = headingOf("", [japanese], 240);
  expect(made.comment.length).toBeGreaterThan(2);
  expect(made.comment.join("")).toBe(japanese);
  expect(headingOf("x".repeat(200), [], 300).title.join("")).toBe("x".repeat(200));
});

test("a rung without title and comment has one line", () => {
  expect(headingOf("", [], 300)).toEqual({ title: [], beside: true, comment: [], height: 28 });
});
