/** Values of a verification, as text and as bits. They come as the bytes of the image. */

import type { VerifyColumn } from "../../wire/types";
import type { Format, ValueShape } from "../format/formats";
import { bytesOf } from "../format/hex";
import { formatString, formatValue, lampOf } from "../format/values";

export type ValueType = Pick<VerifyColumn, "type" | "kind" | "size"> & { values?: VerifyColumn["values"] };

interface ShownValue {
  text: string;
  /** True, false, or null for what is not a BOOL. */
  lamp: boolean | null;
}

export const NOTHING = "–";

export function shapeOf({ type, kind, size, values = [] }: ValueType): ValueShape {
  const named = values.map(([name, value]) => ({ name, value }));
  return { type, kind: kind as ValueShape["kind"], size, values: named };
}

/** The text of a value from its bytes (hex, in the order of the image); null: there is none. */
export function shownValue(of: ValueType, hex: string | null, format: Format = "default"): ShownValue {
  if (hex === null || hex === "") return { text: NOTHING, lamp: null };
  const bytes = bytesOf(hex);
  if (of.kind === "string") return { text: stringText(bytes, of), lamp: null };
  if (bytes.length > 8) return { text: `16#${hex.toUpperCase()}`, lamp: null };
  const view = new DataView(new ArrayBuffer(8));
  bytes.forEach((byte, at) => {
    view.setUint8(at, byte);
  });
  const shape = shapeOf(of);
  return { text: formatValue(shape, view, 0, format) || `16#${hex.toUpperCase()}`, lamp: lampOf(shape, view, 0) };
}

/** A STRING is its length in two bytes, then the characters; in some dialects the characters up to the first 0, in one byte more than it has room for. */
function stringText(bytes: Uint8Array, { type, size }: ValueType): string {
  const wide = type.startsWith("WSTRING");
  const ended = !wide && size === Number(/\[(\d+)\]/.exec(type)?.[1]) + 1;
  const zero = bytes.indexOf(0);
  const head = ended ? 0 : 2;
  const length = !ended ? (bytes[0] ?? 0) | ((bytes[1] ?? 0) << 8) : zero < 0 ? bytes.length : zero;
  let text = "";
  for (let at = 0; at < length; at += 1) {
    const from = head + (wide ? 2 * at : at);
    if (from >= bytes.length) break;
    text += String.fromCharCode((bytes[from] ?? 0) | (wide ? (bytes[from + 1] ?? 0) << 8 : 0));
  }
  return formatString(text, wide ? '"' : "'");
}

/** Bits of two values from the highest to the lowest, in groups of four; null where bits are not useful (long values). */
export function bitsBeside(a: string, b: string, kind: string): { a: string; differs: boolean }[][] | null {
  const one = bytesOf(a);
  const other = bytesOf(b);
  if (one.length === 0 || one.length !== other.length || one.length > 8) return null;
  const low = kind === "bool" && (one[0] ?? 0) < 2 && (other[0] ?? 0) < 2;
  const bits: { a: string; differs: boolean }[] = [];
  for (let byte = one.length - 1; byte >= 0; byte -= 1)
    for (let bit = low ? 0 : 7; bit >= 0; bit -= 1) {
      const set = ((one[byte] ?? 0) >> bit) & 1;
      bits.push({ a: String(set), differs: set !== (((other[byte] ?? 0) >> bit) & 1) });
    }
  const groups: { a: string; differs: boolean }[][] = [];
  for (let at = 0; at < bits.length; at += 4) groups.push(bits.slice(at, at + 4));
  return groups;
}

export const differingBits = (groups: readonly (readonly { differs: boolean }[])[]) =>
  groups.flat().filter(({ differs }) => differs).length;
