/** Converts the raw bytes of a variable to the text that a programmer expects, by the symbol's kind. */
import { formatTime } from "./durations";
import { based, type Format, inFormat, type ValueShape } from "./formats";

/** The sort key of a row: numbers sort by size, texts alphabetically with numbers by size, rows without a value last. */
export type SortKey = number | bigint | string | null;

/** True, false, or null for a value that is not a BOOL: decides about the lamp before the value. */
export function lampOf(shape: ValueShape, view: DataView, offset: number): boolean | null {
  return shape.kind === "bool" ? view.getUint8(offset) !== 0 : null;
}

/** The text of the value in the eight bytes from `offset`. */
export function formatValue(shape: ValueShape, view: DataView, offset: number, format: Format = "default"): string {
  if (format !== "default") {
    const shown = inFormat(shape, bitsOf(shape.size, view, offset), format);
    if (shown !== null) return shown;
  }
  const name = format === "default" ? enumName(shape, view, offset) : null;
  if (name !== null) return name;
  switch (shape.kind) {
    case "bool":
      return view.getUint8(offset) !== 0 ? "TRUE" : "FALSE";
    case "int":
      return signed(shape.size, view, offset).toString();
    case "uint":
      return bitsOf(shape.size, view, offset).toString();
    case "bits":
      return based(bitsOf(shape.size, view, offset), shape.size, "hex");
    case "real":
      return shape.size === 4 ? formatReal32(view.getFloat32(offset, true)) : formatReal(view.getFloat64(offset, true));
    case "time":
      return formatTime(view.getBigInt64(offset, true), shape.type === "LTIME" ? "LTIME" : "T");
    case "date":
      return formatDate(shape.type ?? "", view.getBigInt64(offset, true));
    case "char":
      return formatString(
        String.fromCharCode(shape.size === 2 ? view.getUint16(offset, true) : view.getUint8(offset)),
        shape.size === 2 ? '"' : "'",
      );
    case "ref": {
      const reference = view.getBigUint64(offset, true);
      return reference === 0n ? "NULL" : `-> image+${reference & 0xffffffffn}`;
    }
    default:
      return "";
  }
}

/** The sort key of the value in the eight bytes from `offset`. */
export function sortKeyAt(shape: ValueShape, view: DataView, offset: number): number | bigint {
  if (shape.kind === "real") return shape.size === 4 ? view.getFloat32(offset, true) : view.getFloat64(offset, true);
  const isSigned = shape.kind === "int" || shape.kind === "time" || shape.kind === "date";
  return isSigned ? signed(shape.size, view, offset) : bitsOf(shape.size, view, offset);
}

/** The name of an enumeration's value; null for other types, and for numbers without a name. */
function enumName(shape: ValueShape, view: DataView, offset: number): string | null {
  if (!shape.values?.length) return null;
  const value = shape.kind === "int" ? signed(shape.size, view, offset) : bitsOf(shape.size, view, offset);
  return shape.values.find((known) => BigInt(known.value) === value)?.name ?? null;
}

function signed(size: number, view: DataView, offset: number): bigint {
  return BigInt.asIntN(size * 8, view.getBigUint64(offset, true));
}

function bitsOf(size: number, view: DataView, offset: number): bigint {
  return BigInt.asUintN(size * 8, view.getBigUint64(offset, true));
}

/** Four hex digits without a prefix, as status words are written: 80F4. */
export function hexWord(view: DataView, offset: number): string {
  return view.getUint16(offset, true).toString(16).toUpperCase().padStart(4, "0");
}

function formatReal(value: number): string {
  if (Number.isNaN(value)) return "NaN";
  if (!Number.isFinite(value)) return value > 0 ? "+Inf" : "-Inf";
  const text = value.toString();
  return /[.e]/.test(text) ? text : `${text}.0`;
}

// The shortest text that reads back as the same single-precision number: 0.1, not 0.10000000149011612.
function formatReal32(value: number): string {
  if (!Number.isFinite(value)) return formatReal(value);
  for (let digits = 1; digits <= 9; digits += 1) {
    const text = Number(value.toPrecision(digits));
    if (Math.fround(text) === value) return formatReal(text);
  }
  return formatReal(value);
}

const DAY = 86_400_000_000_000n;
const DATE_PREFIXES: Record<string, string> = {
  DATE: "D",
  LDATE: "LDATE",
  TIME_OF_DAY: "TOD",
  LTIME_OF_DAY: "LTOD",
  DATE_AND_TIME: "DT",
  LDATE_AND_TIME: "LDT",
};

/** D#2026-11-21, TOD#12:30:00.5, DT#2026-11-21-12:30:00: nanoseconds since 1970 or since midnight, as a literal. */
export function formatDate(type: string, ns: bigint): string {
  const days = ns >= 0n ? ns / DAY : -((-ns + DAY - 1n) / DAY);
  const date = new Date(Number(days) * 86_400_000).toISOString().replace(/T.*/, "");
  const time = clock(ns - days * DAY);
  const prefix = DATE_PREFIXES[type] ?? type;
  if (prefix.endsWith("TOD")) return `${prefix}#${time}`;
  return prefix === "D" || prefix === "LDATE" ? `${prefix}#${date}` : `${prefix}#${date}-${time}`;
}

function clock(ns: bigint): string {
  const two = (value: bigint) => value.toString().padStart(2, "0");
  const seconds = ns / 1_000_000_000n;
  const rest = (ns % 1_000_000_000n).toString().padStart(9, "0").replace(/0+$/, "");
  const whole = `${two(seconds / 3600n)}:${two((seconds / 60n) % 60n)}:${two(seconds % 60n)}`;
  return rest ? `${whole}.${rest}` : whole;
}

/** 'it''s' the IEC way: $-escapes for quotes, control characters and the dollar itself. */
export function formatString(text: string, quote = "'"): string {
  const names: Record<string, string> = {
    [quote]: `$${quote}`,
    $: "$$",
    "\n": "$L",
    "\r": "$R",
    "\t": "$T",
    "\f": "$P",
  };
  let out = quote;
  for (const c of text) {
    const code = c.charCodeAt(0);
    out += names[c] ?? (code < 0x20 ? `$${code.toString(16).toUpperCase().padStart(2, "0")}` : c);
  }
  return `${out}${quote}`;
}
