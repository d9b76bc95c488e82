import { expect, test } from "vitest";
import {
  freeNumber,
  freePlace,
  kindsOf,
  NO_HARDWARE,
  racksOf,
  readFitted,
  withField,
  withItem,
  withoutItem,
} from "./hardware";

const TEXT = `{
  "version": 1,
  "owner": "line 3",
  "fitted": [
    {"kind": "basic-io-unit", "rack": 0, "slot": 0},
    {"kind": "fal",  "number": 42, "note": "keep", "name": "pump"}
  ]
}
`;
const line = (text: string, at: number) => text.split("\n")[at - 1];

test("what is fitted is read with its lines", () => {
  expect(readFitted(TEXT)).toEqual([
    { index: 0, item: { kind: "basic-io-unit", rack: 0, slot: 0 }, first: 5, last: 5 },
    { index: 1, item: { kind: "fal", number: 42, name: "pump" }, first: 6, last: 6 },
  ]);
});

test.each(["", "{", "[]", '{"fitted": 3}', '{"fitted": [3]}', '{"fitted": [], }', '{"fitted": [] /* a note */}'])(
  "%s can only be edited as text",
  (text) => expect(readFitted(text)).toBeNull(),
);

test("a change of a field leaves everything else as it is", () => {
  expect(withField(TEXT, 1, "number", 7)).toBe(TEXT.replace("42", "7"));
  expect(withField(TEXT, 1, "name", 'a "b"')).toBe(TEXT.replace('"pump"', '"a \\"b\\""'));
  expect(line(withField(TEXT, 0, "name", "Inputs"), 5)).toBe(
    '    {"kind": "basic-io-unit", "rack": 0, "slot": 0, "name": "Inputs"},',
  );
  expect(line(withField(TEXT, 1, "rack", 1), 6)).toContain('"number": 42, "rack": 1, "note": "keep"');
  expect(line(withField(TEXT, 1, "name", null), 6)).toBe('    {"kind": "fal",  "number": 42, "note": "keep"}');
  expect(line(withField(TEXT, 1, "kind", null), 6)).toBe('    {"number": 42, "note": "keep", "name": "pump"}');
  expect(withField(TEXT, 9, "name", "x")).toBe(TEXT);
});

test("something new is on a line like the others, and what goes takes its comma along", () => {
  const more = withItem(TEXT, { kind: "rack", number: 1, name: "" });
  expect(line(more, 6)).toMatch(/},$/);
  expect(line(more, 7)).toBe('    {"kind": "rack", "number": 1}');
  expect(withoutItem(more, 2)).toBe(TEXT);
  expect(line(withoutItem(TEXT, 0), 5)).toContain('"fal"');
  const one = withItem(NO_HARDWARE, { kind: "inner-board" });
  expect(one).toBe('{\n  "version": 1,\n  "fitted": [\n    {"kind": "inner-board"}\n  ]\n}\n');
  expect(withoutItem(one, 0)).toBe(NO_HARDWARE);
});

test("numbers and slots that are free, racks that are named", () => {
  const fitted = readFitted(withItem(TEXT, { kind: "special-io-unit", number: 0, rack: 2, slot: 1 })) ?? [];
  const range = (kind: string, lowest: number, highest: number) => ({ kind, lowest, highest });
  expect(freeNumber(fitted, range("special-io-unit", 0, 95))).toBe(1);
  expect(freeNumber(fitted, range("special-io-unit", 0, 0))).toBeNull();
  expect(racksOf(fitted, range("rack", 0, 3))).toEqual([0, 2]);
  expect(racksOf(fitted, range("rack", 0, 1))).toEqual([0]);
  expect(freePlace(fitted, [0, 2], range("slot", 0, 9))).toEqual({ rack: 0, slot: 1 });
  expect(freePlace(fitted, [0], range("slot", 0, 0))).toBeNull();
});

test("the kinds of a model come in the order of the page", () => {
  const fits = ["fal", "slot", "module", "cpu-bus-unit", "rack"].map((kind) => ({ kind, lowest: 0, highest: 1 }));
  expect(kindsOf(fits).map(({ kind }) => kind)).toEqual(["rack", "cpu-bus-unit", "module", "fal"]);
});
