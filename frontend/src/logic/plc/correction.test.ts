import { expect, it } from "vitest";
import { corrections } from "./correction";

it.each([
  ["Main.x: 1800 is outside of INT (0..1500) (0 to 1500)", "1800", ["1500"]],
  ["Main.x: -3 is outside of INT (0 to 1500)", "-3", ["0"]],
  ["Main.x: 300 is outside of USINT (0 to 255)", "16#12C", ["255"]],
  ["Main.x: 40000 is outside of the subrange -5..5", "40000", ["5"]],
  ["Main.go: `yes` is not a BOOL; write TRUE or FALSE", "yes", ["TRUE", "FALSE"]],
  ["Main.c: `blau` is not Colour; write RED, GREEN, BLUE, WHITE", "blau", ["RED", "GREEN", "BLUE"]],
  ["Main.r: `x` is not REAL; write a number, e.g. 1.5", "x", []],
  ["Main.x: `a` is not INT; write an integer from 0 to 1500, or 16#FF", "a", []],
  ["A402.12 is read-only for tools", "1", []],
])("%s", (message, entry, meant) => {
  expect(corrections(message, entry)).toEqual(meant);
});
