import { expect, test } from "vitest";
import { indentAfter, indentOfOpener } from "./indent";

const after = (...lines: string[]) => indentAfter((line) => lines[line - 1] ?? "", lines.length + 1, "  ");
const opener = (...lines: string[]) => indentOfOpener((line) => lines[line - 1] ?? "", lines.length);

test.each([
  [["  IF a THEN"], "    "],
  [["  IF a THEN // b"], "    "],
  [["  IF a THEN b := 1; END_IF;"], "  "],
  [["  ELSIF a = ':' THEN (* so *)"], "    "],
  [["  ELSE"], "    "],
  [["  FOR i := 1 TO 2 DO"], "    "],
  [["  CASE n OF"], "    "],
  [["    1, 2:"], "      "],
  [["VAR_INPUT"], "  "],
  [["VAR RETAIN"], "  "],
  [["VAR a : INT; END_VAR"], ""],
  [["TYPE"], "  "],
  [["  Recipe : STRUCT"], "    "],
  [["PROGRAM Main"], ""],
  [["FUNCTION A : INT // so"], ""],
  [["FUNCTION A : INT END_FUNCTION"], ""],
  [["VAR_GLOBAL", "  a : INT;", "END_VAR"], ""],
  [["PROGRAM Main", "END_PROGRAM", "VAR_GLOBAL", "END_VAR"], ""],
  [["PROGRAM Main", "VAR", "  a : INT;", "END_VAR"], ""],
  [["FUNCTION_BLOCK A", "  METHOD b", "  VAR a : INT; END_VAR"], "  "],
  [["  a := 1;", ""], "  "],
  [["  a : ARRAY[1..4] OF"], "  "],
  [["RUNG"], "  "],
  [['  RUNG start: "It holds" // so'], "    "],
  [['{off} NETWORK "Off"'], "  "],
  [["  rung := 1;"], "  "],
  [["RUNG [a] (b) END_RUNG"], ""],
  [["  [go]", "    (on)", "  END_RUNG"], "  "],
  [[], ""],
])("after %j", (lines, expected) => {
  expect(after(...lines)).toBe(expected);
});

test.each([
  [["  IF a THEN", "    b := 1;", "    END_IF"], "  "],
  [["  IF a THEN", "    IF b THEN", "    END_IF;", "    ELSE"], "  "],
  [["  IF a THEN", "    IF b THEN c := 1; END_IF;", "    elsif"], "  "],
  [["  CASE n OF", "    1: IF a THEN", "      b := 1;", "      ELSE"], "    "],
  [["  CASE n OF", "    1:", "      ELSE"], "  "],
  [["  RUNG", "    [a] (b)", "    END_RUNG"], "  "],
  [["  {off} NETWORK", "    END_NETWORK"], "  "],
  [["  REPEAT", "    a := 1;", "    UNTIL"], "  "],
  [["PROGRAM Main", "VAR_INPUT", "  a : INT;", "  END_VAR"], ""],
  [["FUNCTION_BLOCK A", "  FUNCTION : INT", "  END_FUNCTION_BLOCK"], ""],
  [["TYPE", "  Recipe : STRUCT", "    a : INT;", "    END_STRUCT"], "  "],
  [["  a := 1;", "  END_IF"], null],
  [["PROGRAM Main", "VAR", "END_VAR", "  VAR_OUTPUT"], ""],
  [["FUNCTION_BLOCK A", "  METHOD b", "    VAR_INPUT"], "  "],
  [["FUNCTION_BLOCK A", "  METHOD b", "  END_METHOD", "    VAR"], ""],
  [["PROGRAM Main", "  VARIANT"], null],
  [["  VAR_GLOBAL"], null],
  [["  IF a THEN", "    END_IF;"], "  "],
  [["  IF a THEN", "    elsewhere"], null],
  [["  IF a THEN", "    END_"], null],
])("the opener of the last of %j", (lines, expected) => {
  expect(opener(...lines)).toBe(expected);
});
