import { expect, test } from "vitest";
import { writeElement } from "./args";
import { type Around, type Box, type Edit, namesIn } from "./edit";
import { emptyInRung, rungEdit } from "./keys";
import { callOf } from "./ladderBox";
import { pinAtPoint, spotOfPin } from "./ladderPins";
import { readRung } from "./ladderRead";
import { networksIn } from "./networks";
import { Sheet } from "./sheet";

const known = (name: string, kind: Box["kind"], inputs: readonly string[], more: Partial<Box> = {}): Box => ({
  ...{ name, kind, type: "", inputs, outputs: [], types: [], by_position: kind === "function", more: false },
  ...{ comment: "" },
  ...more,
});
const TON = known("TON", "block", ["IN", "PT"], { outputs: ["Q", "ET"], types: ["BOOL", "TIME", "BOOL", "TIME"] });
const AROUND: Around = { boxes: [TON, known("ADD", "function", ["IN1", "IN2"])], names: namesIn("ton1") };

/** The rung after a key at a place, with what was typed into the fields. */
function after(body: string, key: string, place: readonly number[], ...typed: string[]): Edit {
  const [found] = networksIn(`RUNG\n    ${body}\nEND_RUNG\n`);
  const read = found && readRung(found);
  if (!found || read?.kind !== "rung") throw new Error(body);
  let made = rungEdit({ head: found.head, path: read.path, indent: "", comments: false }, key, place);
  for (const text of typed) made = made && "naming" in made ? (made.naming?.taken(text, AROUND) ?? null) : null;
  if (!made || "refused" in made) throw new Error(key);
  return made;
}
const bodyOf = ({ text }: Edit) =>
  text
    .split("\n")
    .slice(1, -1)
    .map((line) => line.trim())
    .join(" ");

test("a block gets the power at its first input of BOOL, an instance of its own, and hands the power on", () => {
  const made = after("[a] (b)", "f", [0], "ton", "wait");
  expect(bodyOf(made)).toBe("[a] wait(IN := ~, PT := ???).Q (b)");
  expect(made.declares).toEqual([{ name: "wait", type: "TON" }]);
  expect(after("[a]", "f", [0], "TON").naming?.value).toBe("ton2");
});

test("a function, and what has no input of BOOL, gets the power at EN; so does a block with Shift", () => {
  expect(bodyOf(after("[a]", "f", [0], "ADD"))).toBe("[a] ??? := ADD(EN := ~, IN1 := ???, IN2 := ???).ENO");
  expect(bodyOf(after("[a]", "Shift+F", [0], "TON", "t"))).toBe("[a] t(EN := ~, IN := ???, PT := ???).ENO");
  const count = known("n", "instance", ["by"], { outputs: ["n"], types: ["INT", "INT"] });
  expect(writeElement(callOf(count, "n", false))).toBe("n(EN := ~, by := ???).ENO");
});

test("jumps and links end their path, and a branch goes around the element at the cursor", () => {
  expect(bodyOf(after("[a]", "j", [0], "out"))).toBe("[a] JMP out");
  expect(bodyOf(after("[a]", "Shift+J", [0]))).toBe("[a] RETURN");
  expect(bodyOf(after("< [a] | [b] > (c)", "#", [0, 1, 0], "low"))).toBe("< [a] | [b] -> #low > (c)");
  expect(bodyOf(after("[a] (b)", "Shift+#", [0], "low"))).toBe("[a] #low (b)");
  expect(bodyOf(after("[a] [b] (c)", "b", [1]))).toBe("[a] < [b] | > (c)");
  expect(() => after("[a] JMP out", "j", [0], "in")).toThrow();
});

test("a box is drawn before it has a name, and before its result has a variable", () => {
  for (const edit of [after("[a]", "f", [0]), after("[a]", "f", [0], "ADD")]) {
    const [found] = networksIn(`${edit.text}\n`);
    expect(found && readRung(found).kind).toBe("rung");
  }
});

test("Backspace deletes what is to the left of the cursor", () => {
  expect(bodyOf(after("[a] [b] (c)", "Backspace", [1]))).toBe("[b] (c)");
  expect(bodyOf(after("[a] [b] (c)", "Delete", [1]))).toBe("[a] (c)");
});

test("a name with a type is declared, also after a mode", () => {
  const made = after("[a]", "/", [0], "/halt : BOOL");
  expect(bodyOf(made)).toBe("[a] [/halt]");
  expect(made.declares).toEqual([{ name: "halt", type: "BOOL" }]);
});

test.each([
  ["T#2s", "wait(IN := ~, PT := T#2s).Q"],
  ["TIME#1h2m", "wait(IN := ~, PT := TIME#1h2m).Q"],
  ["16#FF", "wait(IN := ~, PT := 16#FF).Q"],
  ["'a, (b'", "wait(IN := ~, PT := 'a, (b').Q"],
  ["-1.5E3", "wait(IN := ~, PT := -1.5E3).Q"],
  ["D#2020-01-02", "wait(IN := ~, PT := D#2020-01-02).Q"],
  ["a + b", "wait(IN := ~, PT := a + b).Q"],
])("an open pin takes %s, in its own field and in that of its box", (typed, written) => {
  const body = "[a] wait(IN := ~, PT := ???).Q (b)";
  expect(bodyOf(after(body, "Pin:1", [1], typed))).toBe(`[a] ${written} (b)`);
  expect(bodyOf(after(body, "F2", [1], typed))).toBe(`[a] ${written} (b)`);
});

test.each(["", "a, b := c", "a)", "T#1s); x(", "// c"])("a pin does not take %s", (typed) => {
  expect(() => after("wait(IN := ~, PT := ???).Q", "Pin:1", [0], typed)).toThrow("Pin:1");
});

test("a pin declares what it names, and the variable of a result is a pin, too", () => {
  const made = after("wait(IN := ~, PT := ???).Q", "Pin:1", [0], "late : TIME");
  expect(bodyOf(made)).toBe("wait(IN := ~, PT := late).Q");
  expect(made.declares).toEqual([{ name: "late", type: "TIME" }]);
  expect(bodyOf(after("??? := ADD(EN := ~, IN1 := a, IN2 := ???).ENO", "Pin:-2", [0], "sum"))).toBe(
    "sum := ADD(EN := ~, IN1 := a, IN2 := ???).ENO",
  );
});

test("Tab goes from pin to pin", () => {
  const [found] = networksIn("RUNG\n    wait(IN := ~, PT := ???).Q count(CU := ~, PV := 3)\nEND_RUNG\n");
  if (!found) throw new Error("no rung");
  expect(emptyInRung(found, found.text, [0])).toEqual({ place: [0], key: "Pin:1" });
  expect(emptyInRung(found, found.text, [1])).toBeNull();
});

test("a click means the pin whose row it is in", () => {
  const [part] = new Sheet().of(
    "PROGRAM P\nRUNG\n    wait(IN := ~, PT := ???, ET => seen).Q\nEND_RUNG\nEND_PROGRAM\n",
    600,
  );
  const drawing = part?.kind === "rung" ? part.drawing : null;
  const frame = drawing?.elements[0]?.frame;
  if (!drawing || !frame) throw new Error("no box");
  const [, pt] = frame.inputs;
  expect(pinAtPoint(drawing, frame.x - 20, pt?.y ?? 0)).toEqual({ place: [0], pin: 1 });
  expect(pinAtPoint(drawing, frame.x + frame.width + 20, frame.outputs.at(-1)?.y ?? 0)).toEqual({ place: [0], pin: 2 });
  expect(pinAtPoint(drawing, frame.x + 20, frame.y + 4)).toBeNull();
  expect(spotOfPin(drawing, [0], 1)?.y).toBe((pt?.y ?? 0) + 4);
  const field = spotOfPin(drawing, [0], 1);
  // Beside its box, also at the left rail.
  expect((field?.x ?? 0) + (field?.width ?? 0)).toBeLessThan(frame.x);
  expect(field?.x).toBeGreaterThan(-60);
});
