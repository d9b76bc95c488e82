import { describe, expect, it } from "vitest";
import { bitsBeside, differingBits, NOTHING, shownValue } from "./verifyValues";

const INT = { type: "INT", kind: "int", size: 2 };

describe("values of a verification", () => {
  it("are the bytes of the image, lowest first", () => {
    expect(shownValue(INT, "5802").text).toBe("600");
    expect(shownValue(INT, "ffff").text).toBe("-1");
    expect(shownValue(INT, "5802", "hex").text).toBe("16#0258");
    expect(shownValue({ type: "LREAL", kind: "real", size: 8 }, "000000000000f83f").text).toBe("1.5");
    expect(shownValue({ type: "TIME", kind: "time", size: 8 }, "00ca9a3b00000000").text).toBe("T#1s");
  });

  it("have a lamp for a BOOL only", () => {
    expect(shownValue({ type: "BOOL", kind: "bool", size: 1 }, "01")).toEqual({ text: "TRUE", lamp: true });
    expect(shownValue(INT, "0100").lamp).toBeNull();
  });

  it("show the name of an enumeration's number", () => {
    const type = { ...INT, type: "Colour", values: [["Red", 1] as [string, number], ["Green", 2] as [string, number]] };
    expect(shownValue(type, "0200").text).toBe("Green");
    expect(shownValue(type, "0300").text).toBe("3");
  });

  it("have the length that a STRING states; a WSTRING has units of two bytes", () => {
    const text = { type: "STRING[5]", kind: "string", size: 7 };
    expect(shownValue(text, "02004f4b586161").text).toBe("'OK'");
    expect(shownValue(text, "0000").text).toBe("''");
    expect(shownValue({ type: "WSTRING[2]", kind: "string", size: 6 }, "0100c4301234").text).toBe('"ツ"');
    const ended = { type: "STRING[5]", kind: "string", size: 6 };
    expect(shownValue(ended, "4f4b00586161").text).toBe("'OK'");
    expect(shownValue(ended, "68656c6c6f00").text).toBe("'hello'");
    // A wrong length does not go beyond the bytes.
    expect(shownValue(text, "ff004f4b").text).toBe("'OK'");
  });

  it("say when they are missing or too long", () => {
    expect(shownValue(INT, null).text).toBe(NOTHING);
    expect(shownValue({ type: "X", kind: "struct", size: 10 }, "00112233445566778899").text).toBe(
      "16#00112233445566778899",
    );
  });
});

describe("bits beside each other", () => {
  it("are ordered from the highest to the lowest, and marked where they differ", () => {
    const groups = bitsBeside("1802", "5802", "int");
    expect(groups?.map((group) => group.map(({ a }) => a).join("")).join(" ")).toBe("0000 0010 0001 1000");
    expect(groups?.flat().findIndex(({ differs }) => differs)).toBe(9);
    expect(differingBits(groups ?? [])).toBe(1);
  });

  it("are only the one significant bit for a BOOL", () => {
    expect(bitsBeside("01", "00", "bool")).toEqual([[{ a: "1", differs: true }]]);
    expect(bitsBeside("81", "00", "bool")?.flat()).toHaveLength(8);
  });

  it("are omitted where one side has none, and for texts", () => {
    expect(bitsBeside("", "5802", "int")).toBeNull();
    expect(bitsBeside("00".repeat(12), "00".repeat(12), "string")).toBeNull();
  });
});
