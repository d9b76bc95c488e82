import { expect, it } from "vitest";
import { isPouName, kindOf, languagesOf, nameOf, skeleton } from "./skeleton";

it("begins a file with what its name says, or with what was chosen", () => {
  expect(skeleton("plant/inputs.csv", { input: "CIO0" })).toContain("time; CIO0\n");
  expect(skeleton("plant/tank.st")).toContain("PROGRAM tank");
  expect(skeleton("FB_New.st")).toContain("FUNCTION_BLOCK FB_New");
  expect(skeleton("Line 2.st")).toContain("PROGRAM Line_2");
  expect(skeleton("FB_New.st", { kind: "function" })).toContain("FUNCTION FB_New : INT");
  expect(kindOf("ST_Part")).toBe("type");
});

it("writes instructions only where there is a body", () => {
  expect(skeleton("Belt.st", { kind: "function_block", language: "IL" })).toContain("LD   enable");
  expect(skeleton("Belt.st", { kind: "type", language: "IL" })).toBe(skeleton("Belt.st", { kind: "type" }));
});

it("what is drawn begins with an empty network, or a step", () => {
  expect(skeleton("FB_New.st", { language: "FBD" })).toMatch(
    /VAR\nEND_VAR\nNETWORK\nEND_NETWORK\nEND_FUNCTION_BLOCK\n$/,
  );
  expect(skeleton("f_new.st", { language: "LD" })).toMatch(/END_VAR\nRUNG\nEND_RUNG\nEND_FUNCTION\n$/);
  expect(skeleton("new.st", { language: "SFC" })).toMatch(/END_VAR\nINITIAL_STEP Init:\nEND_STEP\nEND_PROGRAM\n$/);
  expect(languagesOf("function")).not.toContain("SFC");
});

it("a file of which nothing could be declared is told before it is made", () => {
  for (const name of ["1 bad", "IF", "end_var", "var_input.st", "plant/2.st"])
    expect(isPouName(nameOf(name))).toBe(false);
  for (const name of ["Lift_1", "water tank", "plant/tank.st", "模様", "iff"])
    expect(isPouName(nameOf(name))).toBe(true);
});
