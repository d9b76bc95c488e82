import { describe, expect, it } from "vitest";
import { variablesIn } from "./inline";

const names = (line: string) => variablesIn(line).variables.map(({ path }) => path);

describe("the variables of a line", () => {
  it("are named once, in order", () => {
    expect(names("ioHold := ioError OR hold AND iohold;")).toEqual(["ioHold", "ioError", "OR", "hold", "AND"]);
  });
  it("go down to members and fixed elements", () => {
    expect(names("zone.jams := belt[3].count + a[i].x;")).toEqual(["zone.jams", "belt[3].count", "a", "i"]);
  });
  it("are neither calls nor parameters nor literals", () => {
    expect(names("jam(IN := run AND NOT sensor, PT := T#1500ms, Q => done);")).toEqual([
      "run",
      "AND",
      "NOT",
      "sensor",
      "done",
    ]);
    expect(names("alarm := E_Alarm#IoUnit; n := 16#FF + 1_000;")).toEqual(["alarm", "n"]);
  });
  it("stand in no comment and no string", () => {
    expect(names("a := 'b c $' d'; // e")).toEqual(["a"]);
    expect(names("a (* b *) := c;")).toEqual(["a", "c"]);
    expect(variablesIn("(* begins").comment).toBe(true);
    expect(variablesIn("still *) x := 1;", true).variables.map(({ path }) => path)).toEqual(["x"]);
  });
  it("know where they begin", () => {
    expect(variablesIn("  x := y;").variables).toEqual([
      { path: "x", column: 3 },
      { path: "y", column: 8 },
    ]);
  });
});
