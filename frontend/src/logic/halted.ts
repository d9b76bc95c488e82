/** Where a PLC is halted, in words. */
import type { HaltInfo } from "../wire/types";
import { baseName } from "./paths";
import { t } from "./text";

/** `at breakpoint, line 29`: below the state word. */
export function haltDetail(halt: HaltInfo): string {
  const why = t(`debug.reason.${halt.reason}`);
  return halt.file === "" ? why : t("debug.atline", { why, line: halt.line });
}

/** `line 29`. */
export const haltShort = (halt: HaltInfo) =>
  halt.file === "" ? t(`debug.reason.${halt.reason}`) : t("debug.line", { line: halt.line });

export const haltPlace = (halt: HaltInfo) => (halt.file === "" ? "" : `${baseName(halt.file)}:${halt.line}`);
