import { describe, expect, it } from "vitest";
import { type Format, formatsFor, inFormat, literalOf, type ValueShape } from "./formats";

const word: ValueShape = { kind: "bits", size: 2 };
const int: ValueShape = { kind: "int", size: 2 };
const uint: ValueShape = { kind: "uint", size: 2 };
const dword: ValueShape = { kind: "bits", size: 4 };

describe("a value in a format", () => {
  it.each<[ValueShape, bigint, Format, string]>([
    [int, 0xfffen, "decimal", "-2"],
    [uint, 0xfffen, "decimal", "65534"],
    [uint, 0xfffen, "signed", "-2"],
    [int, 0xfffen, "unsigned", "65534"],
    [int, 0xfffen, "hex", "16#FFFE"],
    [word, 5n, "binary", "2#0000000000000101"],
    [word, 0x1234n, "bcd", "1234"],
    [word, 0x12f4n, "bcd", "16#12F4"],
    [dword, 0x3f800000n, "float", "1.0"],
    [dword, 0x3dcccccdn, "float", "0.1"],
    [{ kind: "uint", size: 8 }, 0x3ff8000000000000n, "float", "1.5"],
    [uint, 65_000n, "time", "T#1m5s"],
    [word, 0x4142n, "ascii", "'AB'"],
    [word, 0x4100n, "ascii", "'A.'"],
    [{ kind: "time", size: 8 }, 1_500_000n, "decimal", "1.5"],
    [{ kind: "real", size: 4 }, 0x3f800000n, "hex", "16#3F800000"],
  ])("%o %d as %s is %s", (shape, bits, format, text) => {
    expect(inFormat(shape, bits, format)).toBe(text);
  });

  it("is the default one where the type has no such format", () => {
    expect(inFormat(word, 1n, "float")).toBeNull();
    expect(inFormat({ kind: "bool", size: 1 }, 1n, "hex")).toBeNull();
    expect(formatsFor({ kind: "string", size: 80 })).toEqual([]);
  });
});

describe("an entry in a format", () => {
  it.each<[ValueShape, Format, string, string]>([
    [int, "hex", "FFFE", "-2"],
    [word, "hex", "ff", "255"],
    [word, "hex", "16#FF", "16#FF"],
    [word, "binary", "1010", "10"],
    [word, "bcd", "1234", String(0x1234)],
    [int, "unsigned", "65534", "-2"],
    [uint, "signed", "-1", "65535"],
    [int, "decimal", "70000", "70000"],
    [dword, "float", "1.5", String(0x3fc00000)],
    [uint, "time", "T#1m5s", "65000"],
    [uint, "time", "1500", "1500"],
    [word, "ascii", "AB", String(0x4142)],
    [word, "ascii", "'AB'", String(0x4142)],
    [word, "ascii", "ABC", "ABC"],
    [word, "bcd", "12F4", "12F4"],
    [{ kind: "time", size: 8 }, "decimal", "250", "T#250ms"],
    [{ kind: "time", size: 8 }, "decimal", "T#1s", "T#1s"],
    [int, "default", "FFFE", "FFFE"],
  ])("%o %s %s is %s", (shape, format, typed, literal) => {
    expect(literalOf(shape, format, typed)).toBe(literal);
  });
});
