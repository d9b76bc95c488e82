import { act, renderHook } from "@testing-library/react";
import { beforeEach, expect, test, vi } from "vitest";
import type { Around } from "../../../../logic/graphic/edit";
import type { Found } from "../../../../logic/graphic/networks";
import { Sheet } from "../../../../logic/graphic/sheet";
import { rowKey } from "./reopened";
import { useEditing } from "./useEditing";

let file = "";
vi.mock("./write", () => ({
  writePart: (_: string, { from, to }: Found, text: string) => {
    file = file.slice(0, from) + text + file.slice(to);
  },
}));

const TON = {
  ...{ name: "TON", kind: "block" as const, type: "", inputs: ["IN", "PT"], outputs: ["Q", "ET"], types: [] },
  ...{ by_position: false, more: false, comment: "" },
};
const AROUND: Around = { boxes: [TON], names: new Set() };
const rung = (body: string) => `RUNG\n    ${body}\nEND_RUNG`;
const around = () => AROUND;
const go = () => {};

function drawing(text: string) {
  const sheet = new Sheet();
  file = text;
  const hook = renderHook(({ drawn }) => useEditing({ path: "Main.st", drawn, readOnly: false, go, around }), {
    initialProps: { drawn: sheet.of(text, 640) },
  });
  const seen = () => hook.rerender({ drawn: sheet.of(file, 640) });
  return {
    editing: () => hook.result.current,
    press: (key: string, place: number[], at = 0) =>
      act(() => void hook.result.current.press(key, { rung: at, place })),
    others: (...texts: string[]) => {
      for (const each of texts) {
        file = each;
        seen();
      }
    },
    take: (typed: string) => {
      let taken = false;
      act(() => {
        taken = hook.result.current.take(typed) !== null;
      });
      seen();
      return taken;
    },
  };
}

beforeEach(() => {
  file = "";
});

test.each([
  ["a contact is put in before it", "[a] (q0)", [1], ["[a] [b] (q0)"], "[a] [b] (zzz)"],
  ["one that begins with the same letters", "[a] (q0)", [1], ["[a] [q] (q0)"], "[a] [q] (zzz)"],
  [
    "it is typed in the text, letter by letter",
    "[a] (q0)",
    [1],
    ["[a] [ (q0)", "[a] [b (q0)", "[a] [b] (q0)"],
    "[a] [b] (zzz)",
  ],
  ["others are renamed and put in at once", "[a] [b] (q0)", [2], ["[x] [y] [b] (q0) (q1)"], "[x] [y] [b] (zzz) (q1)"],
  ["one of the same name is put in", "[a] [a] (q0)", [1], ["[c] [a] [a] (q0)"], "[c] [a] [zzz] (q0)"],
])("the coil or contact that is named is found again: %s", (_, before, place, others, after) => {
  const { press, others: edit, take } = drawing(rung(before));
  press("F2", place);
  edit(...others.map(rung));
  expect(take("zzz")).toBe(true);
  expect(file).toBe(rung(after));
});

test("a new contact comes beside what it was put beside, and others see both", () => {
  const { press, others, take, editing } = drawing(rung("[a] [c] (q0)"));
  press("c", [1]);
  others(rung("[x] [a] [c] (q0)"));
  expect(editing().named?.text).toContain("[x] [a] [c]");
  expect(take("new")).toBe(true);
  expect(file).toBe(rung("[x] [a] [c] [new] (q0)"));
});

test("a box and its instance are put into the rung as it is then", () => {
  const { press, others, take } = drawing(rung("[a] (q0)"));
  press("f", [0]);
  others(rung("[a] [b] (q0)"));
  expect(take("TON")).toBe(true);
  others(rung("[a] [b] [c] (q0)"));
  expect(take("timer")).toBe(true);
  expect(file).toMatch(/\[a\] timer.* \[b\] \[c\] \(q0\)/s);
});

test.each([
  ["deleted", rung("[a]")],
  ["renamed", rung("[a] (q7)")],
  ["deleted with its rung", ""],
])("what somebody else %s is not written again, and taken once it is back", (_, after) => {
  const { press, others, take, editing } = drawing(`${rung("[a] (q0)")}\n${rung("[b] (q0)")}`);
  press("F2", [1]);
  others(`${after}\n${rung("[b] (q0)")}`);
  expect(editing().named?.lost).toBe(true);
  expect(take("zzz")).toBe(false);
  expect(file).toBe(`${after}\n${rung("[b] (q0)")}`);
  others(`${rung("[a] [x] (q0)")}\n${rung("[b] (q0)")}`);
  expect(take("zzz")).toBe(true);
  expect(file).toBe(`${rung("[a] [x] (zzz)")}\n${rung("[b] (q0)")}`);
});

test("a rung that comes above moves the field with its rung, and its row stays the same", () => {
  const { press, others, take, editing } = drawing(`${rung("[a] (q0)")}\n${rung("[b] (q1)")}`);
  press("F2", [1], 1);
  const id = editing().named?.opened.id;
  others(`${rung("[n] (q9)")}\n${rung("[a] (q0)")}\n${rung("[b] (q1)")}`);
  const { named } = editing();
  expect([named?.rung, named?.opened.id]).toEqual([2, id]);
  expect([0, 1, 2].map((index) => rowKey(index, named))).toEqual([0, 2, 1]);
  expect(take("zzz")).toBe(true);
  expect(file).toBe(`${rung("[n] (q9)")}\n${rung("[a] (q0)")}\n${rung("[b] (zzz)")}`);
});

test("the title and what is in the rung are written by two", () => {
  const { press, others, take } = drawing(rung("[a] (q0)"));
  press("t", [0]);
  others(rung("[a] [b] (q0)"));
  expect(take("Fill")).toBe(true);
  expect(file).toBe(rung("[a] [b] (q0)").replace("RUNG", 'RUNG "Fill"'));
});

test("a pin of a diagram is named although a line was put in before it", () => {
  const network = (lines: string) => `NETWORK\n${lines}\nEND_NETWORK`;
  const { press, others, take } = drawing(network("    q := AND(a, b);"));
  press("Enter", [0, 1]);
  others(network("    r := OR(c, d);\n    q := AND(a, b);"));
  expect(take("zzz")).toBe(true);
  expect(file).toBe(network("    r := OR(c, d);\n    q := AND(a, zzz);"));
});
