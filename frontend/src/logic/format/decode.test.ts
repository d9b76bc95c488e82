import { describe, expect, it } from "vitest";
import { decodeText } from "./decode";

const bytes = (...values: number[]) => new Uint8Array(values);

describe("text of a file", () => {
  it("reads UTF-8 with and without a byte order mark", () => {
    expect(decodeText(new TextEncoder().encode("größer"))).toBe("größer");
    expect(decodeText(bytes(0xef, 0xbb, 0xbf, 0x41))).toBe("A");
  });

  it("reads UTF-16 by its byte order mark", () => {
    expect(decodeText(bytes(0xff, 0xfe, 0x41, 0x00, 0xe4, 0x00))).toBe("Aä");
    expect(decodeText(bytes(0xfe, 0xff, 0x00, 0x41))).toBe("A");
  });

  it("reads bytes that are not UTF-8 as Latin-1", () => {
    expect(decodeText(bytes(0x67, 0x72, 0xfc, 0x6e))).toBe("grün");
  });
});
