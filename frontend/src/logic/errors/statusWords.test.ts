import { describe, expect, it } from "vitest";
import { statusWords } from "./statusWords";

describe("statusWords", () => {
  it("shows an error code with all of its words, and every other word alone", () => {
    expect(statusWords(["SV20", "_ErrSta"], ["SV20", "SV21"])).toEqual([["SV20", "SV21"], ["_ErrSta"]]);
    expect(statusWords(["A400", "A401"], ["A400"])).toEqual([["A400"], ["A401"]]);
    expect(statusWords(["%MW1"], [])).toEqual([["%MW1"]]);
  });
});
