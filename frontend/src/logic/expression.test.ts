import { describe, expect, it } from "vitest";
import { withName } from "./expression";

describe("a near match", () => {
  it("takes the place of the name that is not known", () => {
    expect(withName("Main.cout > 3 AND start", "Main.cout is not known", "Main.count")).toBe(
      "Main.count > 3 AND start",
    );
    expect(withName("start AND Main.belt[1].rn", "Main.belt[1].rn: no such member", "Main.belt[1].run")).toBe(
      "start AND Main.belt[1].run",
    );
  });

  it("takes the place of the only name when the refusal names none", () => {
    expect(withName("NOT strat", "there is no such variable", "start")).toBe("NOT start");
  });

  it("is all that is left when nothing tells which name is meant", () => {
    expect(withName("a > b", "not known", "c")).toBe("c");
  });
});
