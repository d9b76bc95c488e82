import { expect, test } from "vitest";
import { Sheet } from "./sheet";
import { writtenTwice } from "./writers";

const rungs = (...texts: string[]) =>
  new Sheet()
    .of(texts.map((text) => `RUNG\n  ${text}\nEND_RUNG\n`).join(""), 800)
    .map((drawn, index) => ({ drawn, pou: index < 3 ? "Main" : "Other" }));

test.each([
  [
    ["[a] (q)", "[b] (q)"],
    [[{ name: "q", rungs: [0, 1] }], [{ name: "q", rungs: [0, 1] }]],
  ],
  [["[a] (q) (Q)"], [[{ name: "q", rungs: [0] }]]],
  [
    ["[a] (S q)", "[b] (R q)"],
    [[], []],
  ],
  [
    ["[a] (S q)", "[b] (/q)"],
    [[{ name: "q", rungs: [0, 1] }], [{ name: "q", rungs: [0, 1] }]],
  ],
  [
    ["[a] (q)", "[a] (r)", "[a] (s)", "[a] (q)"],
    [[], [], [], []],
  ],
])("coils of %j", (texts, expected) => {
  expect(writtenTwice(rungs(...texts))).toEqual(expected);
});
