import { expect, test } from "vitest";
import { textChange } from "./textChange";

/** The text after a change, as a server makes it. */
function applied(text: string, change: NonNullable<ReturnType<typeof textChange>>): string {
  const at = ({ line, character }: { line: number; character: number }) =>
    text.split("\n").slice(0, line).join("\n").length + (line > 0 ? 1 : 0) + character;
  return text.slice(0, at(change.range.start)) + change.text + text.slice(at(change.range.end));
}

test.each([
  ["", "a"],
  ["a\nb\n", "a\nb\nc"],
  ["a\nbb\nc", "a\nb\nc"],
  ["aaaa", "aaa"],
  ["aaa", "aaaaa"],
  ["x\ny", ""],
  ["n := 𝒳;", "n := 𝒴;"],
  ["a\n\n\nb", "a\n\nb"],
])("%j becomes %j", (before, after) => {
  const change = textChange(before, after);
  expect(change && applied(before, change)).toBe(after);
});

test("the change is as small as it can be, and whole characters", () => {
  expect(textChange("a\nbc\nd", "a\nbxc\nd")).toEqual({
    range: { start: { line: 1, character: 1 }, end: { line: 1, character: 1 } },
    text: "x",
  });
  expect(textChange("n := 𝒳;", "n := 𝒴;")?.text).toBe("𝒴");
  expect(textChange("same", "same")).toBeNull();
});
