import { describe, expect, it } from "vitest";
import { chosenFor, isAddress, noPathIn, pathsIn, splitPath } from "./paths";

describe("paths", () => {
  it("are split before the last name; addresses are not split", () => {
    expect(splitPath("Main.belt[3].enable")).toEqual({ own: "Main.belt[3].", name: "enable" });
    expect(splitPath("Main.tank[1..3]")).toEqual({ own: "Main.", name: "tank[1..3]" });
    expect(splitPath("Main.a[1].b[i.x]")).toEqual({ own: "Main.a[1].", name: "b[i.x]" });
    expect(splitPath("start")).toEqual({ own: "", name: "start" });
    expect(splitPath("A402.12")).toEqual({ own: "", name: "A402.12" });
    expect(splitPath("CIO 0.00")).toEqual({ own: "", name: "CIO 0.00" });
  });

  it("recognise addresses", () => {
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

  it("are distinguished from expressions, which are not split", () => {
    for (const text of ["a + 3", "Main.a\nMain.b > 3", "a+b", "F(2)", "NOT Main.run", "a MOD b"])
      expect(noPathIn(text)).not.toBeNull();
    expect(noPathIn("Main.x, Main.tank[2].level + 3")).toBe("Main.tank[2].level + 3");
    for (const text of [
      "Main.a",
      "Main.a, Main.b\nD100 D101",
      "CIO 0.00",
      "a[2, 1]",
      "W10:8",
      "p^.x",
      "Main.notch",
      " ",
    ])
      expect(noPathIn(text)).toBeNull();
  });

  it("take the choice made for themselves, else for the nearest owner", () => {
    const chosen = new Map([
      ["Main.a.z", "outer"],
      ["Main.a.z.io", "inner"],
    ]);
    expect(chosenFor(chosen, "Main.a.z.io")).toBe("inner");
    expect(chosenFor(new Map([...chosen].reverse()), "main.a.Z.IO[3].x")).toBe("inner");
    expect(chosenFor(chosen, "Main.a.z.io2")).toBe("outer");
    expect(chosenFor(chosen, "Main.a.z^")).toBe("outer");
    expect(chosenFor(chosen, "Main.a.zone")).toBeUndefined();
  });
});
