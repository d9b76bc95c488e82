/** Where a PLC is halted, in words. */

import { t } from "../../text";
import type { HaltInfo } from "../../wire/types";
import { baseName } from "../format/paths";

/** The reasons that need more than their name: `Main.level changed from 3 to 7`, `error 20 was raised`. */
const TELLING: readonly HaltInfo["reason"][] = ["data breakpoint", "error", "violation", "trap"];

/** What happened, in the debugger's words; empty where the reason is enough. */
export const haltCause = (halt: HaltInfo) => (TELLING.includes(halt.reason) ? halt.text : "");

/** `at breakpoint, line 29`: shown below the state. */
export function haltDetail(halt: HaltInfo): string {
  const why = haltCause(halt) || t(`debug.reason.${halt.reason}`);
  return halt.file === "" ? why : t("debug.atline", { why, line: halt.line });
}

/** `line 29`. */
export const haltShort = (halt: HaltInfo) =>
  halt.file === "" ? t(`debug.reason.${halt.reason}`) : t("debug.line", { line: halt.line });

export const haltPlace = (halt: HaltInfo) => (halt.file === "" ? "" : `${baseName(halt.file)}:${halt.line}`);
