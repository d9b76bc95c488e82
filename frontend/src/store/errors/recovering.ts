/** Recovering errors, several people at once: what somebody else has just taken back is no refusal. */

import { detailsInWords } from "../../logic/errors/catalogue";
import { idOf } from "../../logic/plc/errorInstances";
import { t } from "../../text";
import { send } from "../../wire/send";
import type { ErrorHistoryRow } from "../../wire/types";
import { usePlc } from "../plc/plc";
import { catalogueNow } from "./catalogue";

type Answer = Awaited<ReturnType<typeof send>>;

/** Recovers these errors; null is all that are present. What is gone already is said quietly, and the others are recovered. */
export async function recoverErrors(ids: readonly string[] | null): Promise<Answer> {
  const answer = await send({ type: "recover", ids: ids && [...ids] });
  if (answer.ok || ids === null) return answer;
  const gone = ids.map(rowOfKey).filter((row) => row?.status === "cleared");
  if (gone.length === 0) return answer;
  const said = gone.flatMap((row) => (row ? [alreadyGone(row)] : [])).join(" ");
  const left = ids.filter((key) => rowOfKey(key)?.status === "generated");
  if (left.length === 0) return { ...answer, ok: true, message: said, near: [] };
  const again = await send({ type: "recover", ids: left });
  return again.ok ? { ...again, message: `${again.message}. ${said}` } : again;
}

function rowOfKey(key: string): ErrorHistoryRow | undefined {
  const { instances, errors } = usePlc.getState();
  return instances.get(key) ?? errors.get(idOf(key));
}

/** Who took it back, and how. */
function alreadyGone(row: ErrorHistoryRow): string {
  const error = catalogueNow().byId.get(row.id);
  const details = row.details && detailsInWords(error, row.details);
  const name = [error?.name ?? row.name, details].filter(Boolean).join(", ");
  return t(`errors.already.${row.recovered_way ?? "gone"}`, { error: name, by: row.recovered_by });
}
