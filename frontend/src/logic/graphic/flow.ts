/**
 * The power in a drawing as the code saw it: what was noted at each element in one scan, by the places of elements. While a scan is halted,
 * what it has not come to is that of the scan before.
 */

import type { Flow, FlowElement, FlowValue } from "../../wire/types";
import type { Drawing } from "./ladderLayout";
import { elementIn, holds } from "./places";
import type { Power, PowerNode } from "./power";
import type { DrawnPart } from "./sheet";
import type { Span } from "./tree";

/** What was noted at an element. */
export interface Seen {
  /** Null where it has none of its own, or it is not known. */
  power: Power;
  values: readonly FlowValue[];
  /** Noted in the scan before the one that is halted. */
  stale: boolean;
}

/** What a part of a drawing shows of a scan. */
export interface PartFlow {
  /** By the places of elements, joined by points. */
  at: ReadonlyMap<string, Seen>;
  wires: ReadonlyMap<string, string>;
  /** The scan that is told of; of a part that the halted scan has not come to the one before. */
  scan: number;
  calls: number;
  call: number;
  state: "ran" | "begun" | "last" | "skipped" | "uncalled";
}

/** Where an element of the program that ran is in the shown text; null where the text there is a different one. */
type LineOf = (line: number) => number | null;

/** `flows` are the newest scan, and the one before where that is halted. Null where nothing is known. */
export function partFlow(part: DrawnPart, flows: readonly Flow[], lineOf: LineOf): PartFlow | null {
  const [first, before] = flows;
  if (!first) return null;
  const at = new Map<string, Seen>();
  let begun = false;
  for (const [flow, stale] of [
    [before, true],
    [first, false],
  ] as const) {
    const noted = flow ? notedIn(part, flow, lineOf, stale) : new Map<string, Seen>();
    for (const [place, seen] of noted) at.set(place, seen);
    if (!stale) begun = noted.size > 0;
  }
  const wires = new Map<string, string>();
  for (const flow of before ? [before, first] : [first])
    for (const { name, text, line } of flow.wires) {
      const shown = lineOf(line);
      if (shown !== null && holds(part, shown)) wires.set(name.toUpperCase(), text);
    }
  const told = begun || first.whole || !before ? first : before;
  const late = [...at.values()].some(({ stale }) => stale);
  const state =
    told.calls === 0 || told.call === 0
      ? "uncalled"
      : at.size === 0
        ? "skipped"
        : told !== first
          ? "last"
          : late
            ? "begun"
            : "ran";
  return { at, wires, scan: told.scan, calls: told.calls, call: told.call, state };
}

function notedIn(part: DrawnPart, flow: Flow, lineOf: LineOf, stale: boolean): Map<string, Seen> {
  const found = new Map<string, Seen>();
  for (const element of flow.elements) {
    const line = lineOf(element.line);
    const place = line === null ? null : elementIn(part, { line, column: element.column });
    if (place === null) continue;
    const key = place.join(".");
    found.set(key, merged(found.get(key), element, stale));
  }
  return found;
}

/** Contacts at the input of a box are part of that box: its own power comes last. */
const merged = (before: Seen | undefined, { power, values }: FlowElement, stale: boolean): Seen => ({
  power,
  values: before ? [...before.values, ...values] : values,
  stale,
});

/** A value that an element saw, by its name: the one that it wrote, if it did. */
export function valueIn(seen: Seen | undefined, name: string): string | null {
  const key = name.replace(/\s/g, "").toUpperCase();
  return seen?.values.findLast((each) => each.name.toUpperCase() === key)?.text ?? null;
}

interface NodePower {
  power: Power;
  stale: boolean;
}

/** The power at each node of a rung. Of what did not run there is none. */
export function seenPower({ nodes, sends, elements }: Drawing, { at }: PartFlow): NodePower[] {
  const bySpan = new Map<Span, Seen | undefined>(
    elements.map(({ element, place }) => [element.span, at.get(place.join("."))]),
  );
  const found: NodePower[] = [];
  const before = (index: number): NodePower => found[index] ?? { power: null, stale: false };
  const any = [...at.values()];
  const rail = { power: any.length > 0, stale: any.length > 0 && any.every(({ stale }) => stale) };
  for (const node of nodes) found.push(nodePower(node, rail, before, bySpan, sends));
  return found;
}

function nodePower(
  node: PowerNode,
  rail: NodePower,
  before: (index: number) => NodePower,
  bySpan: ReadonlyMap<Span, Seen | undefined>,
  sends: ReadonlyMap<string, readonly number[]>,
): NodePower {
  switch (node.kind) {
    case "rail":
      return rail;
    case "end":
      return { power: false, stale: false };
    case "join":
      return joined(node.from.map(before));
    case "receive": {
      const [link, from] = [joined((sends.get(node.name.toUpperCase()) ?? []).map(before)), before(node.from)];
      return { power: from.power === null ? null : from.power && link.power, stale: from.stale || link.stale };
    }
    case "contact":
      return own(bySpan.get(node.contact.span));
    case "box":
      return node.box.output === null ? before(node.from) : own(bySpan.get(node.box.span));
  }
}

const own = (seen: Seen | undefined): NodePower =>
  seen ? { power: seen.power, stale: seen.stale } : { power: false, stale: false };

const joined = (all: readonly NodePower[]): NodePower => ({
  power: all.some(({ power }) => power) ? true : all.some(({ power }) => power === null) ? null : false,
  stale: all.some(({ stale }) => stale),
});
