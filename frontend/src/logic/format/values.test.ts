import { describe, expect, it } from "vitest";
import { formatTime } from "./durations";
import type { ValueShape } from "./formats";
import { formatString, formatValue, hexWord } from "./values";

function text(shape: ValueShape, fill: (view: DataView) => void, format?: "hex" | "binary" | "decimal"): string {
  const view = new DataView(new ArrayBuffer(8));
  fill(view);
  return formatValue(shape, view, 0, format);
}

describe("formatValue", () => {
  it("shows integers by sign and size", () => {
    expect(text({ kind: "int", size: 2 }, (v) => v.setUint16(0, 0xffff, true))).toBe("-1");
    expect(text({ kind: "uint", size: 2 }, (v) => v.setUint16(0, 0xffff, true))).toBe("65535");
    expect(text({ kind: "int", size: 8 }, (v) => v.setBigInt64(0, -(2n ** 63n), true))).toBe("-9223372036854775808");
    expect(text({ kind: "int", size: 2 }, (v) => v.setInt16(0, -2, true), "hex")).toBe("16#FFFE");
  });

  it("shows bit strings in hex, or as asked", () => {
    const set = (v: DataView) => v.setUint16(0, 0x80f4, true);
    expect(text({ kind: "bits", size: 2 }, set)).toBe("16#80F4");
    expect(text({ kind: "bits", size: 2 }, set, "binary")).toBe("2#1000000011110100");
    expect(text({ kind: "bits", size: 2 }, set, "decimal")).toBe("33012");
  });

  it("shows REAL with its own digits, not with those of LREAL", () => {
    expect(text({ kind: "real", size: 4 }, (v) => v.setFloat32(0, 0.1, true))).toBe("0.1");
    expect(text({ kind: "real", size: 4 }, (v) => v.setFloat32(0, 16777216, true))).toBe("16777216.0");
    expect(text({ kind: "real", size: 8 }, (v) => v.setFloat64(0, 0.1 + 0.2, true))).toBe("0.30000000000000004");
    expect(text({ kind: "real", size: 8 }, (v) => v.setFloat64(0, Number.NEGATIVE_INFINITY, true))).toBe("-Inf");
    expect(text({ kind: "real", size: 4 }, (v) => v.setFloat32(0, Number.NaN, true))).toBe("NaN");
  });

  it("shows an enumeration by name, and a number without a name as it is", () => {
    const colour: ValueShape = { kind: "int", size: 2, type: "Color", values: [{ name: "RED", value: -1 }] };
    expect(text(colour, (v) => v.setInt16(0, -1, true))).toBe("RED");
    expect(text(colour, (v) => v.setInt16(0, 7, true))).toBe("7");
  });

  it("shows dates, characters and references as literals", () => {
    const at = (type: string, ns: bigint) => text({ kind: "date", size: 8, type }, (v) => v.setBigInt64(0, ns, true));
    expect(at("DATE", 0n)).toBe("D#1970-01-01");
    expect(at("DATE_AND_TIME", -1_000_000_000n)).toBe("DT#1969-12-31-23:59:59");
    expect(at("LTIME_OF_DAY", 45_000_500_000_000n)).toBe("LTOD#12:30:00.5");
    expect(text({ kind: "char", size: 1 }, (v) => v.setUint8(0, 39))).toBe("'$''");
    expect(text({ kind: "ref", size: 8 }, () => undefined)).toBe("NULL");
    expect(text({ kind: "ref", size: 8 }, (v) => v.setBigUint64(0, 5000n, true))).toBe("-> image+5000");
  });

  it("shows BOOL as TRUE and FALSE", () => {
    expect(text({ kind: "bool", size: 1 }, (v) => v.setUint8(0, 1))).toBe("TRUE");
    expect(text({ kind: "bool", size: 1 }, () => undefined)).toBe("FALSE");
  });
});

describe("formatTime", () => {
  it("writes only the units that are not zero", () => {
    expect(formatTime(0n)).toBe("T#0s");
    expect(formatTime(1_500_000_000n)).toBe("T#1s500ms");
    expect(formatTime(-65_000_000_000n)).toBe("T#-1m5s");
    expect(formatTime(90_061_000_000_001n)).toBe("T#1d1h1m1s1ns");
  });
});

describe("other texts", () => {
  it("escapes strings with dollars", () => {
    expect(formatString("it's $5\n\u0001")).toBe("'it$'s $$5$L$01'");
  });

  it("writes status words with four digits", () => {
    const view = new DataView(new ArrayBuffer(8));
    view.setUint16(0, 0x9a, true);
    expect(hexWord(view, 0)).toBe("009A");
  });
});
