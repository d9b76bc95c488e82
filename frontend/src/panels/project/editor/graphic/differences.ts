/** The differences of the verification row that is selected, at the elements of a drawing where they were made. */

import type { Apart } from "../../../../logic/graphic/apart";
import type { ChartElement } from "../../../../logic/graphic/chartLayout";
import type { Drawn } from "../../../../logic/graphic/ladderLayout";
import { inText } from "../../../../logic/graphic/places";
import type { DrawnPart, Spot } from "../../../../logic/graphic/sheet";
import { shownValue } from "../../../../logic/verify/verifyValues";
import type { VerifyDifference, VerifyRow } from "../../../../wire/types";
import { shownLine } from "../halt";

/** Those in one part. A difference whose line has no element that writes its variable is at none: the table tells of it. */
export function differencesIn(part: DrawnPart, path: string, row: VerifyRow | null): readonly Apart[] {
  const here = (row?.differences ?? []).filter(({ place }) => place?.file === path);
  if (here.length === 0) return NONE;
  const writers = writersIn(part);
  return here.flatMap((difference) => {
    const line = shownLine(path, difference.place?.line ?? 0);
    const writer = writers.find(
      ({ spot, names }) => inText(part, spot.element.span.at).line === line && isOneOf(names, difference.name),
    );
    if (!writer) return [];
    const { x, y, width, place } = writer.spot;
    const values = { key: place.join("."), name: "", ...said(difference) };
    return [{ ...values, x: x + width, y, at: "end" as const, power: false, more: [], first: false }];
  });
}

const NONE: readonly Apart[] = [];

const said = (difference: VerifyDifference) => ({
  control: shownValue({ ...difference, values: [] }, difference.control).text,
  monitor: shownValue({ ...difference, values: [] }, difference.monitor).text,
});

function isOneOf(names: readonly string[], name: string): boolean {
  const wanted = name.toUpperCase();
  return names.some((each) => {
    const written = each.replace(/\s/g, "").toUpperCase();
    return written !== "" && (wanted === written || wanted.endsWith(`.${written}`));
  });
}

interface Writer {
  spot: Spot;
  names: readonly string[];
}

/** What gives variables their values: coils, results and outputs of boxes, targets of lines, Boolean actions. */
function writersIn(part: DrawnPart): Writer[] {
  switch (part.kind) {
    case "rung":
      return (part.drawing?.elements ?? []).map((spot) => ({ spot, names: writtenBy(spot.element) }));
    case "network":
      return (part.drawing?.elements ?? []).map((spot) => ({
        spot,
        names: spot.element.item.outputs.map(({ target }) => target),
      }));
    case "chart":
      return (part.drawing?.elements ?? []).map((spot) => ({ spot, names: actionOf(spot.element) }));
  }
}

const actionOf = (element: ChartElement) => (element.kind === "action" ? [element.action] : []);

function writtenBy(element: Drawn["element"]): string[] {
  if (element.kind === "coil") return [element.operand];
  if (element.kind !== "box") return [];
  const { result, callee, output, args } = element;
  const outs = args.filter(({ out }) => out).map(({ value }) => value);
  return [...outs, ...(result === null ? [] : [result]), ...(output === null ? [] : [`${callee}.${output}`])];
}
