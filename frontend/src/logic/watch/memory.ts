/** A memory area as a grid of words: how many are in a row, what an entry means, how to move. */
import { based, type Format, inFormat, literalOf, type ValueShape } from "../format/formats";

/** The formats of the grid. All cells have the same; a single word has room for no other. */
export const MEMORY_FORMATS = ["hex", "unsigned", "signed", "bcd", "binary", "ascii"] as const;
export type MemoryFormat = (typeof MEMORY_FORMATS)[number];

/** How wide a value may be that is looked for, in bits. */
export const FIND_BITS = [16, 32, 64] as const;
export type FindBits = (typeof FIND_BITS)[number];

export const WORD: ValueShape = { kind: "bits", size: 2, type: "WORD" };

/** One area of a model, whose parts may differ in access. */
export interface WholeArea {
  name: string;
  description: string;
  words: number;
  first: string;
  last: string;
}

interface AreaPart extends WholeArea {
  [more: string]: unknown;
}

/** The areas, each once. */
export function wholeAreas(parts: readonly AreaPart[]): WholeArea[] {
  const areas = new Map<string, WholeArea>();
  for (const { name, description, words, first, last } of parts) {
    const known = areas.get(name);
    if (known) areas.set(name, { ...known, words: known.words + words, last });
    else areas.set(name, { name, description, words, first, last });
  }
  return [...areas.values()];
}

/** Words in a row, by the addresses of word 0 and word 10: ten where these count decimally, so that a row begins with a round number; else eight. */
export function columnsOf([first, tenth]: readonly (string | undefined)[], format: MemoryFormat): number {
  const number = (address = "") => Number(/\d+$/.exec(address)?.[0] ?? Number.NaN);
  const decimal = number(tenth) - number(first) === 10;
  return (decimal ? 10 : 8) / (format === "binary" ? 2 : 1);
}

/** The word that a key moves to; undefined where the key does not move. */
export function movedTo(
  key: string,
  ctrl: boolean,
  now: number,
  words: number,
  columns: number,
  page: number,
): number | undefined {
  const row = now - (now % columns);
  const to = {
    ArrowRight: now + 1,
    ArrowLeft: now - 1,
    ArrowDown: now + columns,
    ArrowUp: now - columns,
    PageDown: now + page * columns,
    PageUp: now - page * columns,
    Home: ctrl ? 0 : row,
    End: ctrl ? words - 1 : row + columns - 1,
  }[key];
  if (to === undefined) return undefined;
  return to < 0 || to >= words ? Math.max(0, Math.min(words - 1, key.startsWith("Arrow") ? now : to)) : to;
}

/** The number that was typed, in the format of the grid; null where it is none. */
export function numberOf(typed: string, format: MemoryFormat, bits: FindBits): bigint | null {
  const text = typed.trim();
  const literal = /^(\d+)#([\da-f_]+)$/i.exec(text);
  if (literal) return literalNumber(Number(literal[1]), (literal[2] ?? "").replaceAll("_", ""));
  const entered = literalOf({ kind: "bits", size: bits / 8 }, format, text);
  return /^-?\d+$/.test(entered) ? BigInt(entered) : null;
}

function literalNumber(base: number, digits: string): bigint | null {
  const prefix = { 2: "0b", 8: "0o", 16: "0x" }[base];
  if (prefix === undefined) return null;
  try {
    return BigInt(prefix + digits);
  } catch {
    return null;
  }
}

/** A word in every format, for its details. */
export const inAll = (value: bigint): { format: Format; text: string }[] =>
  MEMORY_FORMATS.map((format) => ({ format, text: inFormat(WORD, value, format) ?? based(value, 2, "hex") }));
