import { describe, expect, it } from "vitest";
import { parseFrame, textOf } from "./frames";

function frame(ids: number[], values: bigint[], strings: [number, string][]): ArrayBuffer {
  const text = strings.reduce((sum, [, s]) => sum + 8 + s.length, 0);
  const pad = ids.length % 2;
  const buffer = new ArrayBuffer(24 + (ids.length + pad) * 4 + ids.length * 8 + 4 + text);
  const view = new DataView(buffer);
  view.setUint8(0, 1);
  view.setUint8(1, 1);
  view.setUint32(4, ids.length, true);
  view.setBigUint64(8, 4711n, true);
  view.setBigInt64(16, 47_110_000_000n, true);
  let at = 24;
  for (const id of ids) {
    view.setUint32(at, id, true);
    at += 4;
  }
  at += pad * 4;
  for (const value of values) {
    view.setBigInt64(at, value, true);
    at += 8;
  }
  view.setUint32(at, strings.length, true);
  at += 4;
  for (const [id, s] of strings) {
    view.setUint32(at, id, true);
    view.setUint32(at + 4, s.length, true);
    at += 8;
    for (const c of s) {
      view.setUint8(at, c.charCodeAt(0));
      at += 1;
    }
  }
  return buffer;
}

describe("parseFrame", () => {
  it("reads the head, ids, values and strings", () => {
    const parsed = parseFrame(frame([7, 9, 11], [1n, -2n, 3n], [[12, "Größe"]]));
    expect(parsed.full).toBe(true);
    expect(parsed.scan).toBe(4711);
    expect(parsed.timeNs).toBe(47_110_000_000);
    expect([...parsed.ids]).toEqual([7, 9, 11]);
    expect(new DataView(parsed.values.buffer, parsed.values.byteOffset).getBigInt64(8, true)).toBe(-2n);
    expect(parsed.strings.map(({ id, bytes }) => ({ id, text: textOf(bytes, false) }))).toEqual([
      { id: 12, text: "Größe" },
    ]);
  });

  it("pads an odd number of ids to eight bytes", () => {
    const parsed = parseFrame(frame([1], [42n], []));
    expect(parsed.values[0]).toBe(42);
    expect(parsed.strings).toEqual([]);
  });

  it("refuses data that is not a value frame", () => {
    expect(() => parseFrame(new ArrayBuffer(4))).toThrow("too short");
    const wrong = frame([], [], []);
    new DataView(wrong).setUint8(0, 9);
    expect(() => parseFrame(wrong)).toThrow("kind 9");
    expect(() => parseFrame(frame([1, 2], [1n, 2n], []).slice(0, 40))).toThrow("cut off");
  });
});

describe("textOf", () => {
  it("reads a WSTRING with two bytes for each character", () => {
    expect(textOf(new Uint8Array([0x42, 0x30, 0x41, 0x00]), true)).toBe("\u3042A");
  });
});
