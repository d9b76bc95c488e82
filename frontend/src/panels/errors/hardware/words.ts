import type { FittedItem } from "../../../logic/errors/hardware";
import { type TextKey, t } from "../../../text";

const KINDS = [
  "basic-io-unit",
  "communications-port",
  "cpu-bus-unit",
  "fal",
  "fals",
  "inner-board",
  "module",
  "rack",
  "sensor",
  "serial-port",
  "special-io-unit",
  "station",
  "sysmac-bus-master",
] as const;

/** A kind in words: all of them, or one; an unknown kind as the file has it. */
export function kindWord(kind: string, how: "kind" | "one"): string {
  const known = KINDS.find((each) => each === kind);
  const key: TextKey | undefined = known && `hardware.${how}.${known}`;
  return key ? t(key) : kind;
}

/** One thing that is fitted: `Special I/O Unit 3`. */
export function whatIs({ kind, number, rack, slot }: FittedItem): string {
  const word = kindWord(kind, "one");
  if (kind === "basic-io-unit" && rack !== undefined && slot !== undefined) return `${word} ${rack}.${slot}`;
  return number === undefined ? word : `${word} ${number}`;
}
