import { describe, expect, it } from "vitest";
import type { SortKey } from "../format/values";
import { matches, needsAll, nextSort, sorted } from "./watchsort";

const order = (keys: SortKey[], down = false) => sorted(keys, (key) => key, down);

describe("a sorted watch list", () => {
  it("lists numbers by size, texts alphabetically with numbers by size, and entries without a value last", () => {
    expect(order([10, 9.5, 2n ** 60n, -1])).toEqual([-1, 9.5, 10, 2n ** 60n]);
    expect(order(["Main.a[10]", "main.a[9]", null, "Main.B"])).toEqual(["main.a[9]", "Main.a[10]", "Main.B", null]);
    expect(order(["x", 3, null, 1], true)).toEqual(["x", 3, 1, null]);
  });

  it("keeps the list order of equal values", () => {
    const rows = [1, 2, 3].map((id) => ({ id }));
    expect(sorted(rows, () => 7, true)).toEqual(rows);
  });

  it("is sorted up, down and as listed", () => {
    const up = nextSort(null, "type");
    const down = nextSort(up, "type");
    expect([up, down, nextSort(down, "type")]).toEqual([
      { column: "type", down: false },
      { column: "type", down: true },
      null,
    ]);
    expect(nextSort(down, "current")).toEqual({ column: "current", down: false });
  });
});

describe("a filter", () => {
  it("searches all given texts, ignoring case", () => {
    expect(matches("BELT", ["Main.belt", null])).toBe(true);
    expect(matches("int", ["Main.belt", "UINT"])).toBe(true);
    expect(matches("x", ["Main.belt", undefined])).toBe(false);
  });

  it("needs every value only if it filters by values", () => {
    const all = { text: "x", only: "all" } as const;
    expect(needsAll(null, all)).toBe(false);
    expect(needsAll({ column: "target", down: false }, all)).toBe(false);
    expect(needsAll({ column: "current", down: false }, all)).toBe(true);
    expect(needsAll(null, { text: "", only: "changed" })).toBe(true);
    expect(needsAll(null, { text: "", only: "forced" })).toBe(false);
  });
});
