import { describe, expect, it } from "vitest";
import { pathBefore, withName, withPath } from "./expression";

describe("a near match", () => {
  it("replaces the unknown name", () => {
    expect(withName("Main.cout > 3 AND start", "Main.cout is not known", "Main.count")).toBe(
      "Main.count > 3 AND start",
    );
    expect(withName("start AND Main.belt[1].rn", "Main.belt[1].rn: no such member", "Main.belt[1].run")).toBe(
      "start AND Main.belt[1].run",
    );
  });

  it("replaces the only name when the refusal names none", () => {
    expect(withName("NOT strat", "there is no such variable", "start")).toBe("NOT start");
  });

  it("replaces the whole expression when nothing says which name is meant", () => {
    expect(withName("a > b", "not known", "c")).toBe("c");
  });
});

describe("completion in a condition", () => {
  it("finds the path before the caret", () => {
    expect(pathBefore("Main.count > Main.be", 20)).toBe("Main.be");
    expect(pathBefore("Main.count > 3", 14)).toBe("");
    expect(pathBefore("Main.co > 3", 7)).toBe("Main.co");
    expect(pathBefore("belt[1].ru", 10)).toBe("belt[1].ru");
    expect(pathBefore("start AND", 9)).toBe("");
    expect(pathBefore("%IX0", 4)).toBe("%IX0");
  });

  it("replaces it and keeps the rest", () => {
    expect(withPath("Main.co > 3", 7, "Main.count")).toEqual({ text: "Main.count > 3", caret: 10 });
  });
});
