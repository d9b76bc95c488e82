import { useEffect, useMemo } from "react";
import { type AllApart, type Apart, apartIn } from "../../../../logic/graphic/apart";
import { elementIn, holds } from "../../../../logic/graphic/places";
import type { DrawnPart } from "../../../../logic/graphic/sheet";
import { seenAs, useSeenAs } from "../../../../store/debug/seenAs";
import { flowsKey, loadFlows, useVerifyFlows } from "../../../../store/verify/verifyFlows";
import type { Pou, VerifyFlows, VerifyRow } from "../../../../wire/types";
import { shownLine } from "../halt";
import { differencesIn } from "./differences";
import { flowOfPart } from "./followFlow";

const NONE: AllApart = { marks: [], wires: "" };

/** A beside A′ in a part, of the verification row that is selected: at elements, pins and wires, else only where results were written. */
export function useApart(part: DrawnPart, path: string, pou: Pou | undefined, row: VerifyRow | null): AllApart {
  const seen = useSeenAs((all) => (pou === undefined ? undefined : seenAs(all, pou.name)));
  const key = flowsKey(row, pou, seen);
  const flows = useVerifyFlows(({ of }) => (key === null ? null : (of.get(key) ?? null)));
  useEffect(() => {
    if (key !== null) void loadFlows(key);
  }, [key]);
  return useMemo(() => {
    if (!row || row.differences.length === 0) return NONE;
    const found = flows && apartBy(part, path, flows);
    const told = differencesIn(part, path, row);
    const known = new Set(found?.marks.map((mark) => mark.key.split(".").slice(0, keyLength(part)).join(".")));
    const rest = told.filter((each) => !known.has(each.key));
    if (rest.length === 0) return found ?? NONE;
    return { marks: [...(found?.marks ?? []), ...rest], wires: found?.wires ?? "" };
  }, [part, path, row, flows]);
}

/** A pin of a network has its place below its item; what a row tells is of the item. */
const keyLength = ({ kind }: DrawnPart) => (kind === "network" ? 1 : undefined);

function apartBy(part: DrawnPart, path: string, { control, monitor, line, column }: VerifyFlows): AllApart | null {
  const [one, other] = [flowOfPart(part, path, control), flowOfPart(part, path, monitor)];
  if (!one || !other) return null;
  const shown = line === 0 ? 0 : shownLine(path, line);
  return apartIn(part, [one, other], holds(part, shown) ? elementIn(part, { line: shown, column }) : null);
}

/** As one reads it: `run: A TRUE  A′ FALSE`. */
export const pairText = ({ name, control, monitor }: Pick<Apart, "name" | "control" | "monitor">): string =>
  `${name === "" ? "" : `${name}: `}A ${control ?? "–"}  A′ ${monitor ?? "–"}`;
