/** Online changes in words: what happens to the variables, which PLCs are changed, and the result of a build. */

import { t } from "../../text";
import type { LostVariable, OnlineChange } from "../../wire/types";
import { grouped } from "../format/numbers";

export const FATES = ["reinitialized", "new", "removed"] as const;
export type Fate = (typeof FATES)[number];

/** The variables that are not kept, by what happens to them: only reinitialized ones lose a value. */
export function fates(change: OnlineChange): Record<Fate, LostVariable[]> {
  const sorted: Record<Fate, LostVariable[]> = { reinitialized: [], new: [], removed: [] };
  for (const variable of change.lost) sorted[fateOf(variable)].push(variable);
  return sorted;
}

function fateOf({ reason }: LostVariable): Fate {
  return reason === "new" || reason === "removed" ? reason : "reinitialized";
}

/** `58 kept, 1 reinitialized, 1 removed`. */
export function changeNote(change: OnlineChange): string {
  const parts = FATES.filter((fate) => change[fate] > 0).map((fate) =>
    t(`change.note.${fate}`, { count: grouped(change[fate]) }),
  );
  return [t("change.kept", { count: grouped(change.kept) }), ...parts].join(", ");
}

/** The label of the dialog's button; null when no PLC can be changed. */
export function changeVerb(changes: readonly OnlineChange[], chosen: ReadonlySet<number>): string | null {
  const willing = changes.filter(({ refusal }) => refusal === "");
  const changed = willing.filter(({ instance }) => chosen.has(instance));
  const [one] = changed;
  if (!one) return null;
  if (changed.length === 1) return t(changes.length === 1 ? "change.do.one" : "change.do.only", one);
  if (changed.length === changes.length) return t("change.do.all", { count: changes.length });
  return t("change.do.some", { count: changed.length, all: changes.length });
}

/** The result of a build: for which PLCs, with the figures of the selected one, or which PLCs were not changed and why. */
export function builtNote(changes: readonly OnlineChange[], here: number | undefined): string {
  const changed = changes.filter(({ refusal }) => refusal === "");
  const left = changes
    .filter(({ refusal }) => refusal !== "")
    .map((each) => t("change.left", { name: each.name, why: each.refusal }));
  if (changed.length === 0) return [t("build.ok"), ...left].join("; ");
  const names = changed.map(({ name }) => name).join(", ");
  // There is only one line: a PLC that was not changed matters more than figures.
  if (left.length > 0) return [t("change.built", { names }), ...left].join("; ");
  const mine = changed.length === 1 ? changed[0] : changed.find(({ instance }) => instance === here);
  return mine ? t("change.built.note", { names, note: changeNote(mine) }) : t("change.built", { names });
}
