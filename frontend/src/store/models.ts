/** The PLC models that this server knows; asked once. */
import { rest } from "../wire/rest";
import type { ModelSummary } from "../wire/types";

let known: Promise<ModelSummary[]> | null = null;

export function listModels(): Promise<ModelSummary[]> {
  known ??= rest.models().catch((error: unknown) => {
    known = null;
    throw error;
  });
  return known;
}
