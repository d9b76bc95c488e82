import { expect, it } from "vitest";
import { kindOf, skeleton } from "./skeleton";

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
