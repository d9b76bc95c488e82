/** The arithmetic of the timeline: scans to positions on an axis and back, marks that are too close combined to groups. */

import type { Mark } from "../../wire/types";
import { ungrouped } from "../format/numbers";

/** The scans that are shown, from the left edge to the right one. */
export interface Axis {
  from: number;
  to: number;
}

/** The position of a scan: 0 at the left edge, 1 at the right edge. */
export function placeOf(scan: number, axis: Axis): number {
  if (axis.to <= axis.from) return 1;
  return Math.min(1, Math.max(0, (scan - axis.from) / (axis.to - axis.from)));
}

/** The scan at a position, within the axis. */
export function scanAt(place: number, axis: Axis): number {
  const inside = Math.min(1, Math.max(0, place));
  return Math.round(axis.from + inside * (axis.to - axis.from));
}

/** Round numbers along the axis, as many as there is room for. */
export function ticks(axis: Axis, width: number, apart = 92): number[] {
  const most = Math.max(1, Math.floor(width / apart));
  const least = (axis.to - axis.from) / most;
  if (!(least > 0)) return [];
  const step = [1, 2, 5, 10]
    .map((digit) => digit * 10 ** Math.floor(Math.log10(Math.max(1, least))))
    .find((candidate) => candidate >= least);
  if (step === undefined) return [];
  const found: number[] = [];
  for (let scan = Math.ceil(axis.from / step) * step; scan <= axis.to; scan += step) found.push(scan);
  return found;
}

/** A mark of the journal, or of a difference that a verification or a comparison found. */
export type ShownMark = Omit<Mark, "kind"> & { kind: Mark["kind"] | "difference" };

/** Both in the order of their scans. */
export function withDifferences(marks: readonly Mark[], differences: readonly ShownMark[]): readonly ShownMark[] {
  if (differences.length === 0) return marks;
  return [...marks, ...differences].sort((a, b) => a.scan - b.scan);
}

/** Marks at one position of the axis, that of the earliest; `first` is the most severe one and gives the icon. */
export interface Cluster {
  place: number;
  first: ShownMark;
  marks: readonly ShownMark[];
}

/** What matters most when several marks share a position. */
const SERIOUS: readonly ShownMark["kind"][] = [
  "error",
  "difference",
  "disturbance",
  "system",
  "halt",
  "build",
  "recover",
  "mode",
  "force",
  "run",
  "write",
];

/** Marks closer than `apart` pixels to the first mark of a group join the group. Marks and groups are in the order of their scans. */
export function clusters(marks: readonly ShownMark[], axis: Axis, width: number, apart = 16): Cluster[] {
  const found: { place: number; marks: ShownMark[] }[] = [];
  for (const mark of marks) {
    if (mark.scan < axis.from || mark.scan > axis.to) continue;
    const place = placeOf(mark.scan, axis);
    const group = found.at(-1);
    if (group && (place - group.place) * width < apart) group.marks.push(mark);
    else found.push({ place, marks: [mark] });
  }
  keepInside(found, width, apart);
  return found.map(({ place, marks: group }) => ({
    place,
    first: group.reduce((best, mark) => (rank(mark) < rank(best) ? mark : best)),
    marks: group,
  }));
}

/** Room for the number of a group, right of its icon. */
const NUMBER_ROOM = 26;

/** A group at the right edge moves inside, so that its number is not cut off; if it is then too close to the previous one, it joins it. */
function keepInside(found: { place: number; marks: ShownMark[] }[], width: number, apart: number): void {
  const last = found.at(-1);
  const most = 1 - NUMBER_ROOM / width;
  if (!last || last.marks.length < 2 || last.place <= most) return;
  last.place = Math.max(0, most);
  const before = found.at(-2);
  if (!before || (last.place - before.place) * width >= apart) return;
  before.marks.push(...last.marks);
  found.pop();
}

/** The part of the run that enlarges a group of marks; null when they are too close for that. */
export function around(marks: readonly ShownMark[], axis: Axis, whole: Axis): Axis | null {
  const scans = marks.map((mark) => mark.scan);
  const first = Math.min(...scans);
  const span = Math.max(...scans) - first;
  const length = Math.max(LEAST_SHOWN, Math.ceil(span * 1.25));
  if (span === 0 || length >= axis.to - axis.from) return null;
  const from = Math.min(whole.to - length, Math.max(whole.from, first - Math.floor((length - span) / 2)));
  return { from, to: from + length };
}

function rank(mark: ShownMark): number {
  return SERIOUS.indexOf(mark.kind);
}

/** How many marks of each kind, the most severe kind first. */
export function countKinds(marks: readonly ShownMark[]): [ShownMark["kind"], number][] {
  return SERIOUS.map((kind): [ShownMark["kind"], number] => [
    kind,
    marks.filter((mark) => mark.kind === kind).length,
  ]).filter(([, count]) => count > 0);
}

/** The next mark in a direction, for the keyboard. */
export function neighbour(marks: readonly ShownMark[], scan: number, direction: 1 | -1): ShownMark | undefined {
  return direction > 0 ? marks.find((mark) => mark.scan > scan) : marks.findLast((mark) => mark.scan < scan);
}

const LEAST_SHOWN = 20;

/** The part of the run that enlarges a stretch, both ends included; null is the whole run. */
export function closeTo(stretch: Axis, whole: Axis): Axis | null {
  const length = Math.max(LEAST_SHOWN, Math.ceil((stretch.to - stretch.from) * 1.1));
  if (length >= whole.to - whole.from) return null;
  const middle = Math.round((stretch.from + stretch.to - length) / 2);
  const from = Math.min(whole.to - length, Math.max(whole.from, middle));
  return { from, to: from + length };
}

/** A stretch as it is drawn, in fractions of the axis; null when it is not visible. */
export function spanOn(stretch: Axis, axis: Axis): { left: number; width: number } | null {
  if (stretch.to < axis.from || stretch.from > axis.to) return null;
  const left = placeOf(stretch.from, axis);
  // The last scan is part of it: the stretch ends where the next scan begins.
  return { left, width: placeOf(Math.min(axis.to, stretch.to + 1), axis) - left };
}

/** Zooms in or out around a scan; null is the whole run. */
export function zoomed(axis: Axis, whole: Axis, factor: number, around: number): Axis | null {
  const length = Math.max(LEAST_SHOWN, Math.round((axis.to - axis.from) * factor));
  if (length >= whole.to - whole.from) return null;
  const share = placeOf(around, axis);
  const from = Math.min(whole.to - length, Math.max(whole.from, Math.round(around - share * length)));
  return { from, to: from + length };
}

/** A zoomed axis, moved so that a scan is visible. */
export function including(axis: Axis, whole: Axis, scan: number): Axis {
  if (scan >= axis.from && scan <= axis.to) return axis;
  const length = axis.to - axis.from;
  const from = Math.min(whole.to - length, Math.max(whole.from, Math.round(scan - length / 2)));
  return { from, to: from + length };
}

/** Where a key moves to from a scan; "live" is the live end, undefined a key without a meaning here. */
export function stepTo(key: string, scan: number, whole: Axis): number | "live" | undefined {
  const by = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1, PageUp: -100, PageDown: 100 }[key];
  if (by !== undefined) {
    const target = Math.max(whole.from, scan + by);
    return target >= whole.to ? "live" : target;
  }
  if (key === "Home") return whole.from;
  return key === "End" || key === "Escape" ? "live" : undefined;
}

/** A typed scan: digits, with optional spaces between them. */
export function readScan(text: string): number | null {
  const digits = ungrouped(text);
  return /^\d{1,15}$/.test(digits) ? Number(digits) : null;
}

const UNITS = /^(?:(\d+)d)?(?:(\d+)h)?(?:(\d+)m(?!s))?(?:(\d+(?:\.\d+)?)s)?(?:(\d+)ms)?$/;
const CLOCK = /^(?:(\d+)d)?(?:(\d+):)?(\d+):(\d+(?:\.\d+)?)$/;

/** A typed PLC time, in nanoseconds: 1m2s, 90s, 1:02, 01:02:03.250, 2d 01:02:03. */
export function readTime(text: string): number | null {
  const plain = text.replace(/\s/g, "").toLowerCase();
  const found = plain === "" ? null : (UNITS.exec(plain) ?? CLOCK.exec(plain));
  if (!found) return null;
  const [days, hours, minutes, seconds, ms] = [1, 2, 3, 4, 5].map((group) => Number(found[group] ?? 0));
  const whole = (((days ?? 0) * 24 + (hours ?? 0)) * 60 + (minutes ?? 0)) * 60 + (seconds ?? 0);
  return whole * 1e9 + (ms ?? 0) * 1e6;
}
