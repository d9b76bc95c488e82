import { beforeEach, describe, expect, it, vi } from "vitest";
import { recall } from "./localStorage";

const kept = new Map<string, string>();
vi.stubGlobal("localStorage", { getItem: (key: string) => kept.get(key) ?? null });

describe("recall", () => {
  beforeEach(() => kept.clear());

  it.each([
    ["[1,2]", [], [1, 2]],
    ['{"a":1}', {}, { a: 1 }],
    ["7", 3, 7],
    ['{"a":1}', null, { a: 1 }],
  ])("gives %s back", (text, fallback: unknown, expected) => {
    kept.set("scanbench.it", text);
    expect(recall("it", fallback)).toEqual(expected);
  });

  it.each([
    ["{}", []],
    ["[]", {}],
    ["null", {}],
    ['"7"', 3],
    ["{", true],
  ])("takes the fallback for %s", (text, fallback: unknown) => {
    kept.set("scanbench.it", text);
    expect(recall("it", fallback)).toBe(fallback);
  });
});
