/** Details of an error as they are typed: parsed, checked, and converted to the form that the server takes. */

import type { TextKey } from "../../text";
import { t } from "../../text";
import type { ErrorDetail, ErrorInfo } from "../../wire/types";

export type Format = "hex" | "decimal" | "text";

/** The content of a control. The format says how an Edit is read; a List holds the id of its choice. */
export interface Entry {
  text: string;
  format: Format;
}

/** Entries of one error, by the name of the detail. */
export type Entries = Readonly<Record<string, Entry>>;

export interface Trouble {
  key: TextKey;
  values: Record<string, string>;
}

type Reading = { value: string; trouble: null } | { value: null; trouble: Trouble };

/** Whether the person has to enter something: a List with one choice needs no entry. */
export function needsDetails(error: ErrorInfo): boolean {
  return error.details.some(isOpen);
}

/** Whether the device can have several instances of the error present together. */
export function canBeSeveral(error: ErrorInfo): boolean {
  const identifying = error.details.filter(({ identifies }) => identifies !== "");
  return identifying.length > 0 && identifying.every(({ identifies }) => identifies === "several");
}

const isOpen = (detail: ErrorDetail): boolean => detail.control !== "List" || (detail.choices ?? []).length > 1;

/** A text of at most `maximum` characters is sent as it is; all other entries are numbers, in any format. */
export const isText = (detail: ErrorDetail): boolean => detail.base === 0;

const formatOf = (detail: ErrorDetail): Format => (isText(detail) ? "text" : detail.base === 16 ? "hex" : "decimal");

/** The initial entries: the default of each control, or its first choice, or its least number. */
export function defaultEntries(error: ErrorInfo): Entries {
  return Object.fromEntries(
    error.details.map((detail) => [detail.name, { text: first(detail), format: formatOf(detail) }]),
  );
}

/** The entries of a present error, from its history: `rack=2, slot=3`. */
export function entriesIn(error: ErrorInfo, details: string): Entries {
  const said = new Map<string, string>();
  let last = "";
  for (const part of details.split(", ")) {
    const name = part.slice(0, Math.max(0, part.indexOf("=")));
    if (error.details.some((detail) => detail.name === name)) {
      said.set(name, part.slice(name.length + 1));
      last = name;
    } else if (last) said.set(last, `${said.get(last)}, ${part}`); // a text that contains a comma
  }
  const found = [...said].flatMap(([name, text]) => {
    const detail = error.details.find((known) => known.name === name);
    return detail ? [[name, { text, format: formatOf(detail) }] as const] : [];
  });
  return { ...defaultEntries(error), ...Object.fromEntries(found) };
}

function first(detail: ErrorDetail): string {
  if (detail.default) return detail.default;
  if (detail.control === "List") return detail.choices?.[0]?.id ?? "";
  return isText(detail) ? "" : (detail.minimum ?? 0).toString(detail.base).toUpperCase();
}

/** Whether somebody typed something else than what is known. */
export const isEdited = (error: ErrorInfo, typed: Entries, known: Entries): boolean =>
  error.details.some(({ name }) => typed[name]?.text !== known[name]?.text);

/** What is sent to the server for an entry, or why the entry is refused. The server checks again. */
export function readEntry(detail: ErrorDetail, entry: Entry): Reading {
  if (detail.control === "List") return { value: entry.text, trouble: null };
  if (isText(detail)) return readText(detail, entry.text);
  const read = entry.format === "text" ? fromCharacters(entry.text) : fromDigits(entry.text, entry.format);
  if (typeof read !== "number") return refused(read.key, { ...read.values, ...limits(detail, entry.format) });
  const { minimum = null, maximum = null } = detail;
  if ((minimum !== null && read < minimum) || (maximum !== null && read > maximum))
    return refused("entry.range", { text: entry.text.trim(), ...limits(detail, entry.format) });
  return { value: read.toString(detail.base).toUpperCase(), trouble: null };
}

function readText(detail: ErrorDetail, text: string): Reading {
  const wrong = [...text].find((sign) => !/[\x20-\x7e]/.test(sign));
  if (wrong !== undefined) return refused("entry.text", { sign: wrong, ...limits(detail, "text") });
  if (text.length > (detail.maximum ?? 0)) return refused("entry.range", { text, ...limits(detail, "text") });
  return { value: text, trouble: null };
}

function refused(key: TextKey, values: Record<string, string>): Reading {
  return { value: null, trouble: { key, values } };
}

/** The range in the chosen format, and an example from its middle; without a maximum where only the server knows it. */
export function limits(detail: ErrorDetail, format: Format): Record<"low" | "high" | "example", string> {
  const { minimum = null, maximum = null } = detail;
  const low = minimum ?? 0;
  if (format === "text") return { low: "", high: "", example: "AB" };
  const shown = (value: number) =>
    format === "hex" ? value.toString(16).toUpperCase().padStart(width(maximum), "0") : value.toString();
  const middle = maximum === null ? low : low + Math.floor((maximum - low) / 2);
  return { low: shown(low), high: maximum === null ? "" : shown(maximum), example: shown(middle) };
}

/** Why an entry is refused, and an entry that would be accepted. */
export function inWords({ key, values }: Trouble): string {
  return `${t(key, values)} ${t(values.high ? "entry.allowed" : "entry.example", values)}`;
}

const width = (maximum: number | null) => (maximum === null ? 1 : maximum.toString(16).length);

function fromDigits(text: string, format: "hex" | "decimal"): number | Trouble {
  const plain = text.trim().replace(/^(16#|#|0x)/i, "");
  if (plain === "") return { key: "entry.missing", values: {} };
  const wrong = [...plain].find((sign) => !(format === "hex" ? /[0-9a-f]/i : /\d/).test(sign));
  if (wrong !== undefined) return { key: format === "hex" ? "entry.hex" : "entry.decimal", values: { sign: wrong } };
  return Number.parseInt(plain, format === "hex" ? 16 : 10);
}

/** Characters in the order of a word: the first in its upper byte. */
function fromCharacters(text: string): number | Trouble {
  if (text === "") return { key: "entry.missing", values: {} };
  const wrong = [...text].find((sign) => !/[\x20-\x7e]/.test(sign));
  if (wrong !== undefined) return { key: "entry.text", values: { sign: wrong } };
  if (text.length > 4) return { key: "entry.range", values: { text } };
  return [...text].reduce((number, sign) => number * 256 + sign.charCodeAt(0), 0);
}

function characters(value: number): string {
  let text = "";
  for (let rest = value; rest > 0; rest = Math.floor(rest / 256)) text = String.fromCharCode(rest % 256) + text;
  return /^[\x20-\x7e]*$/.test(text) ? text : "";
}

/** The same number in a different format; an entry that cannot be read stays as typed. */
export function reformat(detail: ErrorDetail, entry: Entry, format: Format): Entry {
  if (isText(detail)) return entry;
  const read = entry.format === "text" ? fromCharacters(entry.text) : fromDigits(entry.text, entry.format);
  if (typeof read !== "number") return { text: entry.text, format };
  const hex = () =>
    read
      .toString(16)
      .toUpperCase()
      .padStart(width(detail.maximum ?? null), "0");
  const text = { hex, decimal: () => read.toString(), text: () => characters(read) }[format]();
  return { text, format };
}

/** The problems with the entries of an error, by detail; empty when there are none. */
export function troubles(error: ErrorInfo, entries: Entries): ReadonlyMap<string, Trouble> {
  const found = new Map<string, Trouble>();
  for (const detail of error.details) {
    const entry = entries[detail.name];
    const trouble = entry ? readEntry(detail, entry).trouble : null;
    if (trouble) found.set(detail.name, trouble);
  }
  return found;
}

/** The details as the server takes them; wrong entries are sent as typed, so that the server refuses them. */
export function wireDetails(error: ErrorInfo, entries: Entries): Record<string, string> {
  return Object.fromEntries(
    error.details.flatMap((detail) => {
      const entry = entries[detail.name];
      return entry ? [[detail.name, readEntry(detail, entry).value ?? entry.text] as const] : [];
    }),
  );
}

/** The other errors that have a detail of the same name with the same control. */
export function kindred(error: ErrorInfo, others: readonly ErrorInfo[]): ErrorInfo[] {
  const alike = (other: ErrorInfo) => other.details.some((detail) => isOpen(detail) && sameKind(error, detail));
  return others.filter((other) => other.id !== error.id && alike(other));
}

function sameKind(error: ErrorInfo, detail: ErrorDetail): boolean {
  return error.details.some((own) => own.name === detail.name && own.control === detail.control && isOpen(own));
}

/** The entries of a different error, with those of this one taken over where the detail is the same and the value is valid there. */
export function takenOver(from: ErrorInfo, entries: Entries, to: ErrorInfo, before: Entries): Entries {
  const next = { ...before };
  for (const detail of to.details) {
    const entry = entries[detail.name];
    if (!entry || !sameKind(from, detail) || readEntry(detail, entry).trouble) continue;
    if (detail.control === "List" && !detail.choices?.some((choice) => choice.id === entry.text)) continue;
    next[detail.name] = entry;
  }
  return next;
}
