/** Binary value frames: the watch tap in the PLC's process sends them. The layout is the backend's `web/socket/frames.py`. */

const VALUES = 1;
const HEADER_BYTES = 24;

export interface Frame {
  /** A snapshot of every watched value; otherwise only the changed ones. */
  full: boolean;
  scan: number;
  /** PLC time in nanoseconds; exact up to 104 days, which is enough to show it. */
  timeNs: number;
  ids: Uint32Array;
  /** Eight bytes for each id, in the order of `ids`: the raw little-endian bytes of the variable, zero padded. */
  values: Uint8Array;
  /** Bytes of a STRING (Latin-1) or WSTRING (UTF-16, little endian); of a reference what it refers to, by name (UTF-8). */
  strings: { id: number; bytes: Uint8Array }[];
}

/** Reads a frame without copying the values; throws if it is not a value frame. */
export function parseFrame(buffer: ArrayBuffer): Frame {
  const view = new DataView(buffer);
  if (buffer.byteLength < HEADER_BYTES) throw new Error(`value frame of ${buffer.byteLength} bytes is too short`);
  const kind = view.getUint8(0);
  if (kind !== VALUES) throw new Error(`unknown frame kind ${kind}`);
  const count = view.getUint32(4, true);
  const valuesAt = HEADER_BYTES + Math.ceil((count * 4) / 8) * 8;
  const stringsAt = valuesAt + count * 8;
  if (buffer.byteLength < stringsAt + 4) throw new Error(`value frame is cut off: ${count} values announced`);
  return {
    full: view.getUint8(1) === 1,
    scan: Number(view.getBigUint64(8, true)),
    timeNs: Number(view.getBigInt64(16, true)),
    ids: new Uint32Array(buffer, HEADER_BYTES, count),
    values: new Uint8Array(buffer, valuesAt, count * 8),
    strings: parseStrings(buffer, view, stringsAt),
  };
}

function parseStrings(buffer: ArrayBuffer, view: DataView, start: number): Frame["strings"] {
  const strings: Frame["strings"] = [];
  const count = view.getUint32(start, true);
  let at = start + 4;
  for (let i = 0; i < count; i += 1) {
    const id = view.getUint32(at, true);
    const length = view.getUint32(at + 4, true);
    strings.push({ id, bytes: new Uint8Array(buffer, at + 8, length) });
    at += 8 + length;
  }
  return strings;
}

/** The characters of a STRING, or of a WSTRING with two bytes each. */
export function textOf(bytes: Uint8Array, wide: boolean): string {
  let text = "";
  // Not TextDecoder: its "latin1" is windows-1252, which differs in 0x80 to 0x9F.
  if (wide)
    for (let i = 0; i + 1 < bytes.length; i += 2)
      text += String.fromCharCode((bytes[i] ?? 0) | ((bytes[i + 1] ?? 0) << 8));
  else for (const byte of bytes) text += String.fromCharCode(byte);
  return text;
}
