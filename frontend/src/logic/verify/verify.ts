/** Rows of a verification: what differs in them, and the way from difference to difference. */

import { t } from "../../text";
import type { VerificationInfo, VerifyDifference, VerifyOutput, VerifyRow } from "../../wire/types";
import { grouped } from "../format/numbers";
import type { Unit } from "./verifyColumns";

/** A' as it is shown: on edited inputs if the monitor ran on them. */
export function resultOf(output: VerifyOutput, memory: VerificationInfo["memory"]): string | null {
  return memory === "set" && output.set !== null ? output.set : output.monitor;
}

/** The range of a verification, in the language of the page. */
export function titleOf({ title }: Pick<VerificationInfo, "title">): string {
  if (title === "the whole scan") return t("verify.title.whole");
  const [, of, first, last] = /^(.*), lines? (\d+)(?: to (\d+))?$/.exec(title) ?? [];
  if (of === undefined || first === undefined) return title;
  return last === undefined
    ? t("verify.title.line", { of, line: first })
    : t("verify.title.lines", { of, first, last });
}

/** The scans that were compared and in which the range ran: where it did not, there was nothing of it to compare. */
export const ranIn = ({ compared, not_run }: Pick<VerificationInfo, "compared" | "not_run">) => compared - not_run;

export const isEdited = (row: VerifyRow) => Object.values(row.inputs).some(({ set }) => set !== null);

/** Whether a unit of a row differs: an output with two results, or an input that the monitor would have read differently. */
export function differsIn(row: VerifyRow, { side, column }: Unit, memory: VerificationInfo["memory"]): boolean {
  if (side === "output") {
    const output = row.outputs[column.name];
    return output !== undefined && output.control !== resultOf(output, memory);
  }
  const input = row.inputs[column.name];
  return input?.expected != null && input.expected !== input.recorded;
}

/** The variable of a difference, else of a column; null where there is none, such as for `next statement`. */
export function variableOf(difference: VerifyDifference | null, track: string | null): string | null {
  const name = difference?.name ?? /^(?:input|output):(.*?)(?::A'?)?$/.exec(track ?? "")?.[1] ?? "";
  const plain = name.replace(/ \((?:part|global)\)$/, "");
  return plain === "" || plain.includes(" ") || difference?.cause === "trap" ? null : plain;
}

/** The path of a column: a variable of the block is below the row's instance; any other name is a path or an address already. */
export function memberOf(instance: string, inside: readonly { path: string }[], column: string): string {
  const path = `${instance}.${column}`.toUpperCase();
  const isBelow = inside.some((member) => {
    const head = member.path.toUpperCase();
    return path.startsWith(head) && !/\w/.test(path[head.length] ?? "");
  });
  return isBelow ? `${instance}.${column}` : column;
}

/** The scan before which the variable was written: for an input this scan, for a result the next one. */
export const writtenBefore = (row: VerifyRow, difference: VerifyDifference | null) =>
  difference?.cause === "input" ? row.scan : row.scan + 1;

/** The column to select in a row that differs. */
export const firstDifferingUnit = (
  row: VerifyRow,
  units: readonly Unit[],
  memory: VerificationInfo["memory"],
): Unit | undefined =>
  units.find(({ side, column }) =>
    row.differences.some(({ name, cause }) => name === column.name && (cause === "input") === (side === "input")),
  ) ?? units.find((unit) => differsIn(row, unit, memory));

/** The next row that differs, from a row on (null: from the beginning or the end); null when there is none. */
export function nextDifferent(differing: readonly number[], from: number | null, by: 1 | -1): number | null {
  if (from === null) return (by === 1 ? differing[0] : differing.at(-1)) ?? null;
  if (by === 1) return differing.find((index) => index > from) ?? null;
  return differing.findLast((index) => index < from) ?? null;
}

/** `Main.st, lines 33 to 42` is the server's text; the dialog begins with these fields. */
export interface RangeWish {
  pou?: string | undefined;
  file?: string | undefined;
  first?: number | undefined;
  last?: number | undefined;
  instance?: string | undefined;
}

export const isWholeScan = ({ pou, file }: RangeWish) => !pou && !file;

/** `1 200–1 450 (251)`, one in each line. */
export function stretchLines(stretches: readonly (readonly [number, number])[]): string[] {
  return stretches.map(([first, last]) =>
    first === last ? grouped(first) : `${grouped(first)} – ${grouped(last)} (${grouped(last - first + 1)})`,
  );
}

/** A typed range of scans `a` to `b`: thin gaps, spaces and commas between digits are allowed; null: not a number. */
export function scanTyped(text: string): number | null {
  const digits = text.replace(/[\s\u2009\u202f,._']/g, "");
  return /^\d+$/.test(digits) ? Number(digits) : null;
}

/** The PLC waits for this verification. */
export const isPaced = (info: Pick<VerificationInfo, "state" | "source" | "pace">) =>
  info.source === "live" && info.pace !== "free" && isGoing(info);

export const isGoing = ({ state }: Pick<VerificationInfo, "state">) =>
  state === "starting" || state === "verifying" || state === "waiting";
