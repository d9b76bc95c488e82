/** The PLC models that this server knows; fetched once. */
import { rest } from "../../wire/rest";
import type { ModelInfo, ModelSummary } from "../../wire/types";

let known: Promise<ModelSummary[]> | null = null;

export function listModels(): Promise<ModelSummary[]> {
  known ??= rest.models().catch((error: unknown) => {
    known = null;
    throw error;
  });
  return known;
}

const details = new Map<string, Promise<ModelInfo>>();

/** Everything about one model; fetched once, too. */
export function modelDetails(name: string): Promise<ModelInfo> {
  let asked = details.get(name);
  if (!asked) {
    asked = rest.model(name).catch((error: unknown) => {
      details.delete(name);
      throw error;
    });
    details.set(name, asked);
  }
  return asked;
}
