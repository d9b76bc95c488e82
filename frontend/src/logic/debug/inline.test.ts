import { describe, expect, it } from "vitest";
import { variablesIn } from "./inline";

const names = (line: string) => variablesIn(line).variables.map(({ path }) => path);

describe("the variables that a line names", () => {
  it("are listed once each, in the order of the line", () => {
    expect(names("ioHold := ioError OR hold AND iohold;")).toEqual(["ioHold", "ioError", "OR", "hold", "AND"]);
  });
  it("include members and elements with a fixed index", () => {
    expect(names("zone.jams := belt[3].count + a[i].x;")).toEqual(["zone.jams", "belt[3].count", "a", "i"]);
  });
  it("do not include calls, parameters or literals", () => {
    expect(names("jam(IN := run AND NOT sensor, PT := T#1500ms, Q => done);")).toEqual([
      "run",
      "AND",
      "NOT",
      "sensor",
      "done",
    ]);
    expect(names("alarm := E_Alarm#IoUnit; n := 16#FF + 1_000;")).toEqual(["alarm", "n"]);
  });
  it("are not taken from comments or strings", () => {
    expect(names("a := 'b c $' d'; // e")).toEqual(["a"]);
    expect(names("a (* b *) := c;")).toEqual(["a", "c"]);
    expect(variablesIn("(* begins").comment).toBe(true);
    expect(variablesIn("still *) x := 1;", true).variables.map(({ path }) => path)).toEqual(["x"]);
  });
  it("are not the modes of contacts, coils and actions", () => {
    expect(names("[P go] [/n] (S s) (R r)")).toEqual(["go", "n", "s", "r"]);
    expect(variablesIn("Count(N); Slow(D, T#20ms, n);", false, true).variables.map(({ path }) => path)).toEqual(["n"]);
    expect(names("x := (n OR block(S));")).toEqual(["x", "n", "OR", "S"]);
  });
  it("have the column at which they begin", () => {
    expect(variablesIn("  x := y;").variables).toEqual([
      { path: "x", column: 3 },
      { path: "y", column: 8 },
    ]);
  });
});
