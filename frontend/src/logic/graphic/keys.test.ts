import { expect, test } from "vitest";
import { elementOf, fieldText } from "./field";
import { afterKey } from "./keys";
import { replace } from "./ladderEdit";
import type { Place } from "./ladderLayout";
import { readRung } from "./ladderRead";
import { writeRung } from "./ladderWrite";
import { networksIn } from "./networks";
import type { Path } from "./tree";

const HEAD = { label: "", title: "", comment: [], off: false };
const written = (path: Path) =>
  writeRung(HEAD, path, "")
    .split("\n")
    .slice(1, -1)
    .map((line) => line.trim())
    .join(" ");

function read(body: string): Path {
  const [found] = networksIn(`RUNG\n${body}\nEND_RUNG\n`);
  const rung = found && readRung(found);
  if (!rung || rung.kind === "unread") throw new Error(body);
  return rung.path;
}

test("a motor that holds itself is drawn from nothing by its keys", () => {
  let path: Path = [];
  let place: Place = [];
  for (const [key, name] of [
    ["c", "start"],
    ["w", "motor"],
  ] as const) {
    const made = afterKey(key, path, place);
    if (!made) throw new Error(key);
    const element = elementOf("contact", name);
    if (!element) throw new Error(name);
    [path, place] = [replace(made.path, made.place, element), made.place];
  }
  expect(written(path)).toBe("< [start] | [motor] >");
  place = [0];
  const stop = elementOf("contact", "/stop");
  const coil = elementOf("coil", "motor");
  const closed = afterKey("/", path, place);
  if (!closed || !stop || !coil) throw new Error("nothing was made");
  path = replace(closed.path, closed.place, stop);
  const ended = afterKey("o", path, closed.place);
  if (!ended) throw new Error("no coil");
  expect(written(replace(ended.path, ended.place, coil))).toBe("< [start] | [motor] > [/stop] (motor)");
});

test.each([
  ["!", "[a] (b)", "[/a] (b)"],
  ["!", "[/a] (b)", "[a] (b)"],
  ["e", "[a] (b)", "[P a] (b)"],
  ["E", "[P a] (b)", "[N a] (b)"],
  ["Delete", "[a] (b)", "(b)"],
])("%s makes %s to %s", (key, before, after) => {
  expect(written(afterKey(key, read(before), [0])?.path ?? [])).toBe(after);
});

test("other keys do nothing", () => {
  expect(afterKey("z", read("[a] (b)"), [0])).toBeNull();
  expect(afterKey("!", read("jam(IN := ~).Q"), [0])).toBeNull();
});

test.each([
  ["contact", "/stop", "/stop"],
  ["contact", "P first", "P first"],
  ["contact", "x > 5", "x > 5"],
  ["coil", "S jammed", "S jammed"],
  ["box", "jam(IN := ~, PT := T#1s).Q", "jam(IN := ~, PT := T#1s).Q"],
  ["box", "JMP out", "out"],
] as const)("the field of a %s takes %s", (kind, text, shown) => {
  const element = elementOf(kind, text);
  if (!element || element.kind === "parallel") throw new Error(text);
  expect(fieldText(element)).toBe(shown);
});

test.each([
  ["contact", ""],
  ["contact", "a] [b"],
  ["coil", "a) (b"],
  ["box", "jam("],
  ["box", ""],
] as const)("the field of a %s does not take %s", (kind, text) => {
  expect(elementOf(kind, text)).toBeNull();
});
