/** How this browser arranges the columns of verifications, for each range. */

import { create } from "zustand";
import type { Format } from "../../logic/format/formats";
import {
  type Arrangement,
  moved,
  movedTo,
  plainArrangement,
  toggled,
  type Unit,
} from "../../logic/verify/verifyColumns";
import { keep, recall } from "../page/localStorage";

const KEY = "verify.columns";
const KEPT_RANGES = 30;

type Kept = readonly (readonly [range: string, Arrangement])[];

export const useArrangements = create<{ of: ReadonlyMap<string, Arrangement> }>(() => ({
  of: new Map(recall<Kept>(KEY, []).map(([range, kept]) => [range, { ...plainArrangement, ...kept }])),
}));

export const useArrangement = (range: string): Arrangement =>
  useArrangements(({ of }) => of.get(range) ?? plainArrangement);

function change(range: string, how: (before: Arrangement) => Arrangement): void {
  const of = new Map(useArrangements.getState().of);
  const next = how(of.get(range) ?? plainArrangement);
  of.delete(range);
  of.set(range, next);
  useArrangements.setState({ of });
  keep(KEY, [...of].slice(-KEPT_RANGES));
}

export const toggleHidden = (range: string, key: string) =>
  change(range, (before) => ({ ...before, hidden: toggled(before.hidden, key) }));

export const togglePinned = (range: string, key: string) =>
  change(range, (before) => ({ ...before, pinned: toggled(before.pinned, key) }));

export const setColumnFormat = (range: string, name: string, format: Format) =>
  change(range, (before) => ({ ...before, formats: { ...before.formats, [name]: format } }));

export const moveColumn = (range: string, units: readonly Unit[], key: string, by: 1 | -1) =>
  change(range, (before) => moved(units, before, key, by));

export const dropColumn = (range: string, units: readonly Unit[], key: string, on: string) =>
  change(range, (before) => movedTo(units, before, key, on));

export const resetColumns = (range: string) => change(range, () => plainArrangement);
