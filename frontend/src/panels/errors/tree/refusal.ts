import type { CatalogueRow } from "../../../logic/errors/catalogue";
import type { Outcome } from "../../../store/errors/simulator";

/** The visible row that a refusal is about, if there is one: the reason is shown below that row. */
export function refusedRow(rows: readonly CatalogueRow[], outcome: Outcome | null): string | null {
  if (!outcome || outcome.ok) return null;
  const named = outcome.ids.find((id) => outcome.message.startsWith(`${id}:`));
  const id = outcome.present[0] ?? named ?? (outcome.ids.length === 1 ? outcome.ids[0] : undefined);
  return rows.some((row) => row.key === id) ? (id ?? null) : null;
}
