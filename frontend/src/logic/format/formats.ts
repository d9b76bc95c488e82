/** Numbers in the format that somebody chose for a row. Entries in that row are read in the same format. */
import type { PlcSymbol, WatchEntry } from "../../wire/types";
import { formatTime } from "./durations";

/** How a value can be shown; `default` is the usual format of its type. */
export const FORMATS = [
  "default",
  "decimal",
  "signed",
  "unsigned",
  "hex",
  "binary",
  "bcd",
  "float",
  "time",
  "ascii",
] as const satisfies readonly WatchEntry["format"][];
export type Format = (typeof FORMATS)[number];
export type ValueShape = Pick<PlcSymbol, "kind" | "size"> & Partial<Pick<PlcSymbol, "type" | "values">>;

const NUMBERS = ["int", "uint", "bits"];

/** The formats in which a value of this shape can be shown. */
export function formatsFor(shape: ValueShape): readonly Format[] {
  if (shape.kind === "real") return ["default", "hex", "binary"];
  if (shape.kind === "time") return ["default", "decimal", "hex"];
  if (!NUMBERS.includes(shape.kind)) return [];
  const all: Format[] = ["default", "decimal", "signed", "unsigned", "hex", "binary", "bcd"];
  return [...all, ...(shape.size >= 4 ? (["float"] as const) : []), "time", "ascii"];
}

/** The text of a value (its bits, as an unsigned number); null where its type has no such format, and the default one is shown. */
export function inFormat(shape: ValueShape, bits: bigint, format: Format): string | null {
  if (!formatsFor(shape).includes(format)) return null;
  const signed = BigInt.asIntN(shape.size * 8, bits);
  switch (format) {
    case "decimal":
      if (shape.kind === "time") return milliseconds(signed);
      return (shape.kind === "int" ? signed : bits).toString();
    case "signed":
      return signed.toString();
    case "unsigned":
      return bits.toString();
    case "hex":
    case "binary":
      return based(bits, shape.size, format);
    case "bcd":
      return bcd(bits, shape.size);
    case "float":
      return float(bits, shape.size);
    case "time":
      return formatTime((shape.kind === "int" ? signed : bits) * 1_000_000n);
    case "ascii":
      return ascii(bits, shape.size);
    default:
      return null;
  }
}

export function based(value: bigint, size: number, format: "hex" | "binary"): string {
  return format === "hex"
    ? `16#${value
        .toString(16)
        .toUpperCase()
        .padStart(size * 2, "0")}`
    : `2#${value.toString(2).padStart(size * 8, "0")}`;
}

const milliseconds = (ns: bigint) => `${Number(ns) / 1e6}`;

/** Decimal digits, four bits each; a digit above 9 shows that the value is not BCD. */
function bcd(bits: bigint, size: number): string {
  const digits = bits
    .toString(16)
    .toUpperCase()
    .padStart(size * 2, "0");
  return /[A-F]/.test(digits) ? `16#${digits}` : digits;
}

function float(bits: bigint, size: number): string {
  const view = new DataView(new ArrayBuffer(8));
  view.setBigUint64(0, bits, true);
  const value = size === 4 ? Number(view.getFloat32(0, true).toPrecision(7)) : view.getFloat64(0, true);
  const text = value.toString();
  return /[.eNI]/.test(text) ? text : `${text}.0`;
}

/** The first character is that of the highest byte, as in the number; characters that cannot be printed are dots. */
function ascii(bits: bigint, size: number): string {
  let text = "";
  for (let byte = size - 1; byte >= 0; byte -= 1) {
    const code = Number((bits >> BigInt(8 * byte)) & 0xffn);
    text += code >= 0x20 && code < 0x7f ? String.fromCharCode(code) : ".";
  }
  return `'${text}'`;
}

const MS = { d: 86_400_000, h: 3_600_000, m: 60_000, s: 1000, ms: 1, us: 0.001, ns: 0.000001 };

/** An entry in a row of this format, as a literal that the PLC takes for this type. A literal with `#` states its own
 * type; an entry that cannot be read is sent as it is, and the PLC says why it is refused. */
export function literalOf(shape: ValueShape, format: Format, typed: string): string {
  const text = typed.trim();
  if (!formatsFor(shape).includes(format) || /[#]/.test(text.replace(/^L?(T|TIME)#/i, ""))) return text;
  const bits = bitsIn(shape, format, text.replaceAll("_", ""));
  if (bits === null) return text;
  if (shape.kind === "time") return `T#${bits}ms`;
  const wide = BigInt.asUintN(shape.size * 8, bits);
  if (shape.kind === "real") return based(wide, shape.size, "hex");
  // A number that does not fit is sent as typed, so that the refusal quotes it.
  if (wide !== bits && BigInt.asIntN(shape.size * 8, bits) !== bits) return bits.toString();
  return (shape.kind === "int" ? BigInt.asIntN(shape.size * 8, bits) : wide).toString();
}

function bitsIn(shape: ValueShape, format: Format, text: string): bigint | null {
  switch (format) {
    case "decimal":
    case "signed":
    case "unsigned":
      if (shape.kind === "time" ? !/^-?\d+$/.test(text) : !/^[+-]?\d+$/.test(text)) return null;
      return BigInt(text.replace("+", ""));
    case "hex":
      return /^[0-9a-f]+$/i.test(text) && shape.kind !== "real" && shape.kind !== "time" ? BigInt(`0x${text}`) : null;
    case "binary":
      return /^[01]+$/.test(text) && shape.kind !== "real" ? BigInt(`0b${text}`) : null;
    case "bcd":
      return /^\d+$/.test(text) ? BigInt(`0x${text}`) : null;
    case "float":
      return /^[+-]?(\d|\.\d)/.test(text) && !Number.isNaN(Number(text)) ? floatBits(Number(text), shape.size) : null;
    case "time":
      return duration(text);
    case "ascii":
      return characters(text, shape.size);
    default:
      return null;
  }
}

function floatBits(value: number, size: number): bigint {
  const view = new DataView(new ArrayBuffer(8));
  if (size === 4) view.setFloat32(0, value, true);
  else view.setFloat64(0, value, true);
  return view.getBigUint64(0, true);
}

/** Milliseconds of `T#1m5s`, `1m5s` or a bare number. */
function duration(text: string): bigint | null {
  const body = text.replace(/^L?(T|TIME)#/i, "").toLowerCase();
  if (/^\d+$/.test(body)) return BigInt(body);
  if (!/^(\d+(\.\d+)?(d|h|ms|us|ns|m|s))+$/.test(body)) return null;
  let total = 0;
  for (const [, number, unit] of body.matchAll(/(\d+(?:\.\d+)?)(ms|us|ns|d|h|m|s)/g))
    total += Number(number) * MS[unit as keyof typeof MS];
  return BigInt(Math.round(total));
}

function characters(text: string, size: number): bigint | null {
  const body = /^'.*'$/.test(text) ? text.slice(1, -1) : text;
  if (body.length !== size) return null;
  let bits = 0n;
  for (const c of body) {
    const code = c.charCodeAt(0);
    if (code > 0xff) return null;
    bits = (bits << 8n) | BigInt(code);
  }
  return bits;
}
