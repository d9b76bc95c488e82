import { expect, test } from "vitest";
import { FORM, wantedOf } from "./whatif";

test("each way asks for its own fields, and names the one that is missing", () => {
  expect(wantedOf(FORM)).toBe("scan");
  expect(wantedOf({ ...FORM, scan: "1 200", values: "start" })).toBe("values");
  expect(wantedOf({ ...FORM, scan: "1 200", values: "start = TRUE; Main.a[1] := 4", candidates: "x" })).toMatchObject({
    scan: 1200,
    window: 100,
    values: [
      { path: "start", value: "TRUE" },
      { path: "Main.a[1]", value: "4" },
    ],
    search: false,
    candidates: [],
  });
  expect(wantedOf({ ...FORM, scan: "3", values: "name = 'a;b$'c;'; wide := \"x=;\"; n = 4" })).toMatchObject({
    values: [
      { path: "name", value: "'a;b$'c;'" },
      { path: "wide", value: '"x=;"' },
      { path: "n", value: "4" },
    ],
  });
  expect(wantedOf({ ...FORM, mode: "vary", scan: "3", vary: "name", tried: "'a,b', 'c'" })).toMatchObject({
    tried: ["'a,b'", "'c'"],
  });
  expect(wantedOf({ ...FORM, mode: "vary", scan: "3", vary: "level" })).toBe("tried");
  expect(wantedOf({ ...FORM, mode: "vary", scan: "3", vary: "level", tried: "1, 0..10/5" })).toMatchObject({
    vary: "level",
    tried: ["1", "0..10/5"],
  });
  expect(wantedOf({ ...FORM, mode: "search", scan: "3", candidates: "a; b" })).toBe("condition");
  expect(wantedOf({ ...FORM, mode: "search", scan: "3", candidates: "a; b", condition: "lamp" })).toMatchObject({
    search: true,
    candidates: ["a", "b"],
    condition: "lamp",
  });
});
