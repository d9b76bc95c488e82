import { expect, test } from "vitest";
import { merged, SharedText } from "./sharedText";

/** Two ends that tell each other everything, in the order in which it happens. */
function pair(begun: string) {
  const deltas: unknown[] = [];
  const make = (other: () => SharedText) =>
    new SharedText("draft", {
      onDelta: (delta) => deltas.push(delta),
      onOwn: (update) => other().take(update),
      onText: () => undefined,
    });
  const one: SharedText = make(() => two);
  const two: SharedText = make(() => one);
  one.replace(begun);
  deltas.length = 0;
  return { one, two, deltas };
}

const type = (text: SharedText, at: number, letters: string) =>
  text.typed([{ rangeOffset: at, rangeLength: 0, text: letters }]);

test("each takes back only what was their own, step by step", () => {
  const { one, two } = pair("ab");
  one.endStep();
  type(one, 1, "1");
  type(two, 0, "2");
  one.endStep();
  type(one, 4, "3");
  expect(two.value).toBe("2a1b3");
  one.undo();
  expect(two.value).toBe("2a1b");
  one.undo();
  expect(two.value).toBe("2ab");
  one.redo();
  expect(two.value).toBe("2a1b");
  two.undo();
  expect(one.value).toBe("a1b");
});

test("what the editor typed is not told to it again, what others did is", () => {
  const { one, deltas } = pair("ab");
  type(one, 2, "c");
  expect(deltas).toEqual([[{ retain: 2 }, { insert: "c" }]]); // the other end's
});

test("a mark stays between its letters; one of a different text is nowhere", () => {
  const { one, two } = pair("abcd");
  const mark = one.mark(2);
  type(two, 0, "\u{1f600}");
  expect(one.offsetOf(mark)).toBe(4);
  expect(pair("abcd").one.offsetOf(mark)).toBeNull();
  expect(one.offsetOf("nonsense")).toBeNull();
});

test("two changes of a text are both made", () => {
  expect(merged("a\nb\n", "a1\nb\n", "a\nb2\n")).toBe("a1\nb2\n");
  expect(merged("a", "b", "b")).toBe("b");
  expect(merged("a", "a", "c")).toBe("c");
});

test("what one end lacks is told, and nothing when it lacks nothing", () => {
  const { one } = pair("ab");
  const late = new SharedText("draft", { onDelta: () => undefined, onOwn: () => undefined, onText: () => undefined });
  const lacking = one.lackedBy(late.vector);
  if (lacking) late.take(lacking);
  expect(late.value).toBe("ab");
  expect(one.lackedBy(late.vector)).toBeNull();
});
