import { describe, expect, it } from "vitest";
import { isAddress, pathsIn, splitPath } from "./paths";

describe("paths", () => {
  it("are split before the last name; addresses stay whole", () => {
    expect(splitPath("Main.belt[3].enable")).toEqual({ own: "Main.belt[3].", name: "enable" });
    expect(splitPath("start")).toEqual({ own: "", name: "start" });
    expect(splitPath("A402.12")).toEqual({ own: "", name: "A402.12" });
    expect(splitPath("CIO 0.00")).toEqual({ own: "", name: "CIO 0.00" });
  });

  it("know addresses", () => {
    expect(["%MW3", "D100", "0.00", "CIO 1.05", "W10:8"].every(isAddress)).toBe(true);
    expect(["Main.x1", "start", "belt3"].some(isAddress)).toBe(false);
  });

  it("are found in dropped and typed text", () => {
    expect(pathsIn("Main.a, Main.b\nD100 D101")).toEqual(["Main.a", "Main.b", "D100", "D101"]);
    expect(pathsIn("CIO 0.00")).toEqual(["CIO 0.00"]);
    expect(pathsIn("IF x > 3 THEN")).toEqual(["IF", "x", "3", "THEN"]);
    expect(pathsIn("(* no path *)")).toEqual(["no", "path"]);
    expect(pathsIn("  ")).toEqual([]);
  });
});
