/** What the code of an instance saw on both sides in the verification row that is selected: for drawings. */

import { create } from "zustand";
import type { Pou, VerifyFlows, VerifyRow } from "../../wire/types";
import { verify as wire } from "../../wire/verify";
import { onInstanceChange } from "../plc/reset";
import { shownNow } from "./verify";

/** By row and instance: null where nothing is known, as of a record that was kept. */
export const useVerifyFlows = create<{ of: ReadonlyMap<string, VerifyFlows | null> }>(() => ({ of: new Map() }));

const KEPT = 40;

/** The instance of a POU that a row tells about: where it differs, else the one that is looked at. Undefined: there is none. */
function instanceIn(row: VerifyRow, pou: Pou, seen: string | undefined): string | undefined {
  if (pou.kind === "function") return "";
  const name = pou.name.toUpperCase();
  const place = row.differences.find((each) => each.place?.pou.toUpperCase() === name)?.place;
  return place?.instance ?? seen;
}

/** Names what is known of a POU in a row; null where there is nothing to ask for. `seen`: the instance as which its text is seen. */
export function flowsKey(row: VerifyRow | null, pou: Pou | undefined, seen: string | undefined): string | null {
  const shown = shownNow();
  if (!row || row.differences.length === 0 || !pou || shown?.source.kind !== "verification") return null;
  const path = instanceIn(row, pou, seen);
  return path === undefined
    ? null
    : [shown.source.id, shown.info.generation, row.scan, Math.max(1, row.call), pou.name, path].join(" ");
}

const asked = new Set<string>();

/** Requests it, once. */
export async function loadFlows(key: string): Promise<void> {
  if (asked.has(key)) return;
  asked.add(key);
  const [id, , scan, call, pou = "", path = ""] = key.split(" ");
  let found: VerifyFlows | null;
  try {
    found = await wire.flow(Number(id), Number(scan), Number(call), pou, path);
  } catch {
    found = null; // As of a trace, or of a row whose record is full: the drawing marks the results that differ.
  }
  useVerifyFlows.setState(({ of }) => ({ of: new Map([...of].slice(-KEPT)).set(key, found) }));
}

onInstanceChange(() => {
  asked.clear();
  useVerifyFlows.setState({ of: new Map() });
});
