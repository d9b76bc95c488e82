/** The columns of a verification's table: which there are, in which order, and where they are. */

import type { VerifyColumn } from "../../wire/types";
import type { Format } from "../format/formats";

/** A variable on one side of the table: as an output it has two cells, A and A'. */
export interface Unit {
  key: string;
  side: "output" | "input";
  column: VerifyColumn;
}

/** How somebody arranged the columns, by the keys of units. */
export interface Arrangement {
  order: readonly string[];
  hidden: readonly string[];
  pinned: readonly string[];
  formats: Readonly<Record<string, Format>>;
}

export const plainArrangement: Arrangement = { order: [], hidden: [], pinned: [], formats: {} };

const SIDES = ["output", "input"] as const;

/** All units: outputs, then inputs, each in the order of use. */
export function unitsOf(columns: readonly VerifyColumn[]): Unit[] {
  return SIDES.flatMap((side) =>
    columns.filter((column) => column[side]).map((column) => ({ key: `${side}:${column.name}`, side, column })),
  );
}

/** In the order that somebody chose; a new unit comes after the one it follows in the order of use. Pinned units come first. */
export function inOrder(units: readonly Unit[], { order, pinned }: Arrangement): Unit[] {
  const byKey = new Map(units.map((unit) => [unit.key, unit]));
  const placed = order.flatMap((key) => byKey.get(key) ?? []);
  units.forEach((unit, at) => {
    if (placed.includes(unit)) return;
    const before = units[at - 1];
    placed.splice(before ? placed.indexOf(before) + 1 : 0, 0, unit);
  });
  const rank = (unit: Unit) => (pinned.includes(unit.key) ? 0 : unit.side === "output" ? 1 : 2);
  return placed.sort((a, b) => rank(a) - rank(b));
}

export function arranged(units: readonly Unit[], arrangement: Arrangement): Unit[] {
  return inOrder(units, arrangement).filter(({ key }) => !arrangement.hidden.includes(key));
}

/** Moves a unit one place among those that are shown; it stays on its side. */
export function moved(units: readonly Unit[], arrangement: Arrangement, key: string, by: 1 | -1): Arrangement {
  const shown = arrangement.hidden.includes(key) ? inOrder(units, arrangement) : arranged(units, arrangement);
  const neighbour = shown[shown.findIndex((unit) => unit.key === key) + by];
  return neighbour ? movedTo(units, arrangement, key, neighbour.key) : arrangement;
}

/** Moves a unit to the place of a different unit, as after a drag. */
export function movedTo(units: readonly Unit[], arrangement: Arrangement, key: string, to: string): Arrangement {
  const keys = inOrder(units, arrangement).map((unit) => unit.key);
  const at = keys.indexOf(key);
  const target = keys.indexOf(to);
  if (at < 0 || target < 0 || at === target) return arrangement;
  keys.splice(at, 1);
  keys.splice(target, 0, key);
  return { ...arrangement, order: keys };
}

export function toggled(list: readonly string[], key: string): string[] {
  return list.includes(key) ? list.filter((known) => known !== key) : [...list, key];
}

/** One column of cells. */
export interface Track {
  key: string;
  kind:
    | "mark"
    | "scan"
    | "call"
    | "instance"
    | "place"
    | "control"
    | "monitor"
    | "input"
    | "from"
    | "disturbance"
    | "note";
  width: number;
  left: number;
  /** It stays visible. */
  sticky: boolean;
  unit: Unit | null;
}

const FIXED = { mark: 26, scan: 82, call: 46, instance: 150, place: 190, from: 84, disturbance: 264, note: 320 };

/** Its width depends on the kind of value, and on the name above it. */
function widthOf({ column, side }: Unit): number {
  const { kind, size } = column;
  const value =
    kind === "bool"
      ? 76
      : kind === "string"
        ? Math.min(220, 40 + 7 * Math.max(4, size - 2))
        : kind === "enum" || column.values.length > 0
          ? 24 + 7 * Math.max(6, ...column.values.map(([name]) => name.length))
          : size <= 2
            ? 72
            : 104;
  const name = 18 + 7 * column.name.length;
  return Math.min(260, Math.max(value, side === "output" ? Math.ceil(name / 2) : name));
}

interface TableKind {
  instances: boolean;
  steps: boolean;
  /** How long the longest scan number is, as it is written. */
  scanLength?: number;
}

/** Long scan numbers are never cut: without its first digits a number is a different one. */
const scanWidth = (length: number) => Math.max(FIXED.scan, 18 + 8 * length);

/** The columns that identify a row stay visible on the left, followed by the pinned units. `widths` are those that somebody chose. */
export function tracksOf(
  units: readonly Unit[],
  pinned: readonly string[],
  kind: TableKind,
  widths: Readonly<Record<string, number>> = {},
): Track[] {
  const tracks: Track[] = [];
  let left = 0;
  const add = (key: string, of: Track["kind"], usual: number, sticky: boolean, unit: Unit | null = null) => {
    const width = widths[key] ?? usual;
    tracks.push({ key, kind: of, width, left, sticky, unit });
    left += width;
  };
  const fixed = (sticky: boolean, ...all: (keyof typeof FIXED)[]) => {
    for (const of of all) add(of, of, of === "scan" ? scanWidth(kind.scanLength ?? 0) : FIXED[of], sticky);
  };
  const put = (unit: Unit, sticky: boolean) => {
    const width = widthOf(unit);
    if (unit.side === "input") return add(unit.key, "input", width, sticky, unit);
    add(`${unit.key}:A`, "control", width, sticky, unit);
    add(`${unit.key}:A'`, "monitor", width, sticky, unit);
  };
  const isPinned = ({ key }: Unit) => pinned.includes(key);
  fixed(true, "mark", "scan", "call");
  for (const unit of units.filter(isPinned)) put(unit, true);
  if (kind.instances) fixed(false, "instance");
  if (kind.steps) fixed(false, "place");
  for (const unit of units.filter((known) => !isPinned(known))) put(unit, false);
  fixed(false, "from", "disturbance", "note");
  return tracks;
}

export const wholeWidth = (tracks: readonly Track[]) => tracks.reduce((sum, { width }) => sum + width, 0);

/** How far to scroll so that the visible part stays in place when columns are inserted before it. */
export function heldAcross(before: readonly Track[], now: readonly Track[], left: number): number {
  const covered = (tracks: readonly Track[]) => wholeWidth(tracks.filter(({ sticky }) => sticky));
  const edge = left + covered(before);
  const first = before.find((track) => !track.sticky && track.left + track.width > edge);
  const same = now.find((track) => track.key === first?.key && !track.sticky);
  // At the very beginning the view stays at the beginning.
  if (left <= 0 || !first || !same) return left;
  return Math.max(0, left + same.left - covered(now) - (first.left - covered(before)));
}

/** The columns to draw: those that stay visible, and those in the window, with some room around it. */
export function tracksInSight(tracks: readonly Track[], left: number, width: number, around = 240): Track[] {
  return tracks.filter(
    (track) => track.sticky || (track.left + track.width >= left - around && track.left <= left + width + around),
  );
}
