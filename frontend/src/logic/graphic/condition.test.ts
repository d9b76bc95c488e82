import { expect, it } from "vitest";
import { conditionOf, hasNumbers, holdsBy, variablesOf } from "./condition";

const VALUES: Record<string, string> = {
  go: "TRUE",
  stop: "FALSE",
  level: "62",
  temp: "58.4",
  "Mix.T": "T#1s840ms",
  word: "16#00FF",
  state: "Waiting",
  "s[2].x": "-3",
};

it.each<[string, boolean | null]>([
  ["go", true],
  ["NOT go", false],
  ["go AND NOT stop", true],
  ["stop AND unknown", false],
  ["go AND unknown", null],
  ["unknown OR go", true],
  ["go XOR go", false],
  ["level >= 80", false],
  ["level < 1_000 & go", true],
  ["s[2].x = -3", true],
  ["temp > 58.0", true],
  // As texts of reals are rounded, equality is not known from them.
  ["temp = 58.4", null],
  ["Mix.T >= T#1.84s", true],
  ["Mix.T > TIME#1s840ms", false],
  ["word = 255", true],
  ["word <> 16#FF", false],
  ["go = stop", false],
  ["(go OR stop) AND level = INT#62", true],
  ["state = Waiting", null],
  ["ABS(level) > 3", null],
  ["level + 1 > 3", null],
  ["go (* really *) AND TRUE", true],
  ["go AND", null],
  ["MOD", null],
])("%s is %s", (text, wanted) => {
  expect(holdsBy(conditionOf(text), (name) => VALUES[name] ?? null)).toBe(wanted);
});

it("knows which values are compared", () => {
  expect(variablesOf(conditionOf("go AND level > limit"))).toEqual([
    { name: "go", compared: false },
    { name: "level", compared: true },
    { name: "limit", compared: true },
  ]);
  expect(["go AND stop", "level > 3"].map(hasNumbers)).toEqual([false, true]);
});
