/**
 * The live values: one typed array, written by frames, read by cells. Cells are functions that write to the page
 * directly, so that React does not run twenty times a second.
 */
import type { Format } from "../../logic/format/formats";
import { formatString, formatValue, hexWord, lampOf, type SortKey, sortKeyAt } from "../../logic/format/values";
import { type Frame, textOf } from "../../wire/frames";
import type { PlcSymbol } from "../../wire/types";

interface Reading {
  text: string;
  lamp: boolean | null;
  changed: boolean;
}

type CellFormat = Format | "word";
type Cell = { show: (reading: Reading) => void; format: CellFormat };

interface Entry {
  slot: number;
  symbol: PlcSymbol | null;
  string: string | null;
  /** False until the first value arrives: a first value is not a change. */
  known: boolean;
  changed: boolean;
  /** The mark of its last change. */
  changedAt: number;
  cells: Set<Cell>;
}

const utf8 = new TextDecoder();

/** Counts the frames. */
let frames = 0;
let bytes = new Uint8Array(8 * 256);
let view = new DataView(bytes.buffer);
const freeSlots: number[] = [];
let slots = 0;
const entries = new Map<string, Entry>();
const byId = new Map<number, Entry>();
const dirty = new Set<Entry>();
let scheduled = false;

function entryOf(path: string): Entry {
  let entry = entries.get(path);
  if (!entry) {
    entry = {
      slot: takeSlot(),
      symbol: null,
      string: null,
      known: false,
      changed: false,
      changedAt: 0,
      cells: new Set(),
    };
    entries.set(path, entry);
  }
  return entry;
}

function takeSlot(): number {
  const free = freeSlots.pop();
  if (free !== undefined) return free;
  if ((slots + 1) * 8 > bytes.length) {
    const wider = new Uint8Array(bytes.length * 2);
    wider.set(bytes);
    bytes = wider;
    view = new DataView(bytes.buffer);
  }
  slots += 1;
  return slots - 1;
}

/** The server's id for a path, as long as the program stays the same. */
export function assign(path: string, id: number, symbol: PlcSymbol): void {
  const entry = entryOf(path);
  if (entry.symbol?.type !== symbol.type) entry.known = false;
  entry.symbol = symbol;
  byId.set(id, entry);
}

/** All ids become invalid: the connection or the program changed. The values stay, as the last known ones. */
export function forgetIds(): void {
  byId.clear();
}

/** The shown program has no such variable: an earlier value does not belong to it. */
export function forgetValue(path: string): void {
  const entry = entries.get(path);
  if (!entry) return;
  entry.known = false;
  entry.symbol = null;
  dirty.add(entry);
  schedule();
}

/** Nobody here watches this path any more. Others may still do so: frames then still contain its id, and its slot may already hold a different value. */
export function drop(path: string, id: number): void {
  const entry = entries.get(path);
  byId.delete(id);
  if (!entry || entry.cells.size > 0) return;
  entries.delete(path);
  dirty.delete(entry);
  freeSlots.push(entry.slot);
}

export function apply(frame: Frame): void {
  frames += 1;
  for (let i = 0; i < frame.ids.length; i += 1) {
    const entry = byId.get(frame.ids[i] ?? -1);
    if (entry) take(entry, frame.values, i * 8);
  }
  for (const { id, bytes: data } of frame.strings) {
    const entry = byId.get(id);
    if (!entry) continue;
    const text =
      entry.symbol?.kind === "ref"
        ? utf8.decode(data)
        : textOf(data, entry.symbol?.type.startsWith("WSTRING") ?? false);
    mark(entry, entry.known && entry.string !== text);
    entry.string = text;
  }
  schedule();
}

function take(entry: Entry, values: Uint8Array, from: number): void {
  const to = entry.slot * 8;
  let differs = false;
  for (let b = 0; b < 8; b += 1) {
    const byte = values[from + b] ?? 0;
    if (bytes[to + b] !== byte) {
      bytes[to + b] = byte;
      differs = true;
    }
  }
  if (differs || !entry.known) mark(entry, entry.known && differs);
}

function mark(entry: Entry, changed: boolean): void {
  entry.known = true;
  if (changed) entry.changedAt = frames;
  if (entry.cells.size === 0) return; // no cell shows it
  entry.changed ||= changed;
  dirty.add(entry);
}

function schedule(): void {
  if (scheduled || dirty.size === 0) return;
  scheduled = true;
  requestAnimationFrame(flush);
}

function flush(): void {
  scheduled = false;
  for (const entry of dirty) {
    for (const cell of entry.cells) cell.show(read(entry, cell.format));
    entry.changed = false;
  }
  dirty.clear();
}

function read(entry: Entry, format: CellFormat): Reading {
  const { symbol } = entry;
  const offset = entry.slot * 8;
  if (!entry.known || !symbol) return { text: "", lamp: null, changed: false };
  if (symbol.kind === "ref") return { text: entry.string ?? "", lamp: null, changed: entry.changed };
  if (symbol.kind === "string") {
    const quote = symbol.type.startsWith("WSTRING") ? '"' : "'";
    return { text: formatString(entry.string ?? "", quote), lamp: null, changed: entry.changed };
  }
  const text = format === "word" ? hexWord(view, offset) : formatValue(symbol, view, offset, format);
  return { text, lamp: lampOf(symbol, view, offset), changed: entry.changed };
}

/** Shows the value of a path in a cell from now on, until the returned function is called. */
export function bindCell(path: string, format: CellFormat, show: (reading: Reading) => void): () => void {
  const entry = entryOf(path);
  const cell: Cell = { show, format };
  entry.cells.add(cell);
  show({ ...read(entry, format), changed: false });
  return () => {
    entry.cells.delete(cell);
  };
}

/** Values that change from now on have changed since this mark. */
export const changeMark = () => frames;

export const hasChangedSince = (path: string, mark: number) => (entries.get(path)?.changedAt ?? 0) > mark;

/** The sort key of a value: a number sorts by its size; null while the value is not known. */
export function sortKey(path: string): SortKey {
  const entry = entries.get(path);
  if (!entry?.known || !entry.symbol) return null;
  return entry.symbol.kind === "string" || entry.symbol.kind === "ref"
    ? entry.string
    : sortKeyAt(entry.symbol, view, entry.slot * 8);
}

/** The last known text of a value, for copying and for forcing the current value. */
export function currentText(path: string, format: Format = "default"): string {
  const entry = entries.get(path);
  return entry ? read(entry, format).text : "";
}
