/** `hardware.json`: what is fitted. Its text is changed only where it says something else, so formatting and unknown fields stay. */
import { type Node, type ParseError, parseTree } from "jsonc-parser"; // tells where each value is in the text
import type { HardwareKind } from "../../wire/types";

export const HARDWARE = "hardware.json";
export const NO_HARDWARE = '{\n  "version": 1,\n  "fitted": []\n}\n';

const FIELDS = ["kind", "number", "rack", "slot", "words", "name"] as const;
export type HardwareField = (typeof FIELDS)[number];
export type FittedItem = Partial<Record<Exclude<HardwareField, "kind">, string | number>> & { kind: string };

/** One thing that is fitted, as the file has it, and its lines, for the problems with it. */
export interface Fitted {
  index: number;
  item: FittedItem;
  first: number;
  last: number;
}

/** What can be in a slot. */
const UNITS = ["basic-io-unit", "special-io-unit", "cpu-bus-unit"];
export const hasPlace = (kind: string) => UNITS.includes(kind);
export const hasNumber = (kind: string) => kind !== "inner-board" && kind !== "basic-io-unit";
export const isText = (kind: string) => kind === "fal" || kind === "fals";

const ORDER = ["rack", ...UNITS, "inner-board"];
const LAST = ["fal", "fals"];

/** The kinds that a model has, in the order of the page: racks, units, the rest, numbers of the program. */
export function kindsOf(fits: readonly HardwareKind[]): HardwareKind[] {
  const rank = ({ kind }: HardwareKind) =>
    ORDER.includes(kind) ? ORDER.indexOf(kind) : LAST.includes(kind) ? 100 + LAST.indexOf(kind) : 50;
  return fits.filter(({ kind }) => kind !== "slot").sort((a, b) => rank(a) - rank(b));
}

/** What the text says; null where it is no such file, and can only be edited as text. */
export function readFitted(text: string): Fitted[] | null {
  const list = listIn(text);
  if (!list) return null;
  const nodes = list.children ?? [];
  if (nodes.some(({ type }) => type !== "object")) return null;
  return nodes.map((node, index) => ({
    index,
    item: { kind: "", ...Object.fromEntries(fieldsOf(node)) },
    first: lineAt(text, node.offset),
    last: lineAt(text, endOf(node)),
  }));
}

function fieldsOf(node: Node): [string, string | number][] {
  const known = properties(node).filter(({ name }) => FIELDS.some((field) => field === name));
  return known.map(({ name, value }) => [
    name,
    typeof value.value === "number" ? value.value : String(value.value ?? ""),
  ]);
}

/** With a different value in one field; null takes the field out. */
export function withField(text: string, index: number, field: HardwareField, value: string | number | null): string {
  const node = listIn(text)?.children?.[index];
  if (!node) return text;
  const all = properties(node);
  const at = all.findIndex(({ name }) => name === field);
  const found = all[at];
  if (value === null)
    return found
      ? cut(
          text,
          all.map(({ whole }) => whole),
          at,
        )
      : text;
  const told = JSON.stringify(value);
  if (found) return replaced(text, found.value.offset, endOf(found.value), told);
  const rank = (name: string) => (FIELDS as readonly string[]).indexOf(name);
  const before = all.findLast(({ name }) => rank(name) >= 0 && rank(name) < FIELDS.indexOf(field));
  if (before) return replaced(text, endOf(before.whole), endOf(before.whole), `, "${field}": ${told}`);
  return replaced(text, node.offset + 1, node.offset + 1, `"${field}": ${told}${all.length > 0 ? ", " : ""}`);
}

/** With one thing more, at the end, on a line like the others. */
export function withItem(text: string, item: FittedItem): string {
  const list = listIn(text);
  if (!list) return text;
  const pairs = FIELDS.filter((field) => item[field] !== undefined && item[field] !== "");
  const told = `{${pairs.map((field) => `"${field}": ${JSON.stringify(item[field])}`).join(", ")}}`;
  const nodes = list.children ?? [];
  const last = nodes.at(-1);
  if (!last) return replaced(text, list.offset, endOf(list), `[\n    ${told}\n  ]`);
  const between = /\s*$/.exec(text.slice(list.offset, last.offset))?.[0] ?? "";
  return replaced(text, endOf(last), endOf(last), `,${between}${told}`);
}

export function withoutItem(text: string, index: number): string {
  const list = listIn(text);
  const nodes = list?.children ?? [];
  if (!list || !nodes[index]) return text;
  return nodes.length === 1 ? replaced(text, list.offset, endOf(list), "[]") : cut(text, nodes, index);
}

/** The lowest number that nothing of this kind has; null when there is none. */
export function freeNumber(fitted: readonly Fitted[], { kind, lowest, highest }: HardwareKind): number | null {
  const taken = new Set(fitted.filter(({ item }) => item.kind === kind).map(({ item }) => item.number));
  for (let number = lowest; number <= highest; number += 1) if (!taken.has(number)) return number;
  return null;
}

/** The racks to show: the first one, in which the CPU unit is, and those that the file names. */
export function racksOf(fitted: readonly Fitted[], { lowest, highest }: HardwareKind): number[] {
  const named = fitted.flatMap(({ item }) => (item.kind === "rack" ? [item.number] : [item.rack]));
  const numbers = named.filter((rack) => typeof rack === "number" && rack >= lowest && rack <= highest) as number[];
  return [...new Set([lowest, ...numbers])].sort((a, b) => a - b);
}

export const inSlot = (fitted: readonly Fitted[], rack: number, slot: number) =>
  fitted.find(({ item }) => hasPlace(item.kind) && item.rack === rack && item.slot === slot);

/** The first slot of these racks that is empty. */
export function freePlace(fitted: readonly Fitted[], racks: readonly number[], slots: HardwareKind) {
  for (const rack of racks)
    for (let slot = slots.lowest; slot <= slots.highest; slot += 1)
      if (!inSlot(fitted, rack, slot)) return { rack, slot };
  return null;
}

// ---- the text -------------------------------------------------------------------------------------------------------

function listIn(text: string): Node | null {
  const errors: ParseError[] = [];
  const root = parseTree(text, errors, { disallowComments: true });
  if (root?.type !== "object" || errors.length > 0) return null;
  const list = properties(root).find(({ name }) => name === "fitted")?.value;
  return list?.type === "array" ? list : null;
}

function properties(node: Node): { name: string; value: Node; whole: Node }[] {
  return (node.children ?? []).flatMap((whole) => {
    const [name, value] = whole.children ?? [];
    return name && value ? [{ name: String(name.value), value, whole }] : [];
  });
}

const endOf = (node: Node) => node.offset + node.length;
const replaced = (text: string, from: number, to: number, by: string) => text.slice(0, from) + by + text.slice(to);
const lineAt = (text: string, offset: number) => text.slice(0, offset).split("\n").length;

/** Without one of several in a row, and without its comma. */
function cut(text: string, row: readonly Node[], index: number): string {
  const [before, node, after] = [row[index - 1], row[index], row[index + 1]];
  if (!node) return text;
  if (before) return replaced(text, endOf(before), endOf(node), "");
  return replaced(text, node.offset, after ? after.offset : endOf(node), "");
}
