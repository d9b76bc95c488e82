/** Breakpoints as people see them: shape, place and words. */

import { t } from "../../text";
import type { BreakpointInfo, Pou } from "../../wire/types";
import { pouAt } from "../plc/sourceLines";

/** A drawing of the gutter: filled holds, hollow is off, dashed is not in the program. */
type BreakpointShape = "bp" | "bp-cond" | "bp-log" | "bp-assign" | "bp-data" | "bp-off" | "bp-unbound";

/** What a person decides of a breakpoint. */
export type Wanted = Pick<
  BreakpointInfo,
  | "kind"
  | "enabled"
  | "file"
  | "line"
  | "path"
  | "access"
  | "error"
  | "scan"
  | "condition"
  | "hits"
  | "log"
  | "assign"
  | "instance"
  | "task"
>;

export const PLAIN: Wanted = {
  kind: "line",
  enabled: true,
  file: "",
  line: 0,
  path: "",
  access: "change",
  error: "",
  scan: 0,
  condition: "",
  hits: "",
  log: "",
  assign: "",
  instance: "",
  task: "",
};

/** The list that all browsers share; other groups belong to one tool each. */
export const isShared = (breakpoint: BreakpointInfo) => breakpoint.group === "";

export function shapeOf(breakpoint: Wanted & { verified: boolean }): BreakpointShape {
  if (!breakpoint.enabled) return "bp-off";
  if (!breakpoint.verified) return "bp-unbound";
  if (breakpoint.log) return "bp-log";
  if (breakpoint.assign) return "bp-assign";
  if (breakpoint.kind !== "line") return "bp-data";
  return isPlain(breakpoint) ? "bp" : "bp-cond";
}

const isPlain = ({ condition, hits, instance, task }: Wanted) => !condition && !hits && !instance && !task;

/** Where it stands in the built text. */
export const lineOf = (breakpoint: BreakpointInfo) => breakpoint.at_line || breakpoint.line;

/** What it is at: the POU around its line, a variable, an error, a scan. Without the declarations, the file is what is known. */
export function placeOf(breakpoint: Wanted & { at_line?: number }, pous: readonly Pou[] = []): string {
  switch (breakpoint.kind) {
    case "line":
      return pouAt(pous, breakpoint.file, breakpoint.at_line || breakpoint.line)?.name ?? baseOf(breakpoint.file);
    case "data":
      return breakpoint.path;
    case "error":
      return breakpoint.error || t("debug.bp.anyerror");
    case "scan":
      return t("debug.bp.scan", { scan: breakpoint.scan });
    default:
      return t(`debug.bp.${breakpoint.kind}`);
  }
}

const baseOf = (file: string) => file.replace(/^.*\//, "").replace(/\.[^.]*$/, "");

/** What is special about it, in short: `if jam.Q`, `3rd time`, `off`. */
export function conditionsOf(breakpoint: Wanted): string {
  const said = [
    breakpoint.enabled ? "" : t("debug.bp.off"),
    breakpoint.kind === "data" ? t(`debug.access.${breakpoint.access}`) : "",
    breakpoint.condition && t("debug.bp.if", { condition: breakpoint.condition }),
    breakpoint.hits && t("debug.bp.times", { hits: breakpoint.hits }),
    breakpoint.log && t("debug.bp.says", { log: breakpoint.log }),
    breakpoint.assign,
    breakpoint.instance && t("debug.bp.in", { instance: breakpoint.instance }),
    breakpoint.task && t("debug.bp.task", { task: breakpoint.task }),
  ];
  return said.filter(Boolean).join(" · ");
}

/** All there is to say, for a tooltip. */
export function sayBreakpoint(breakpoint: BreakpointInfo): string {
  const kind = t(`debug.kind.${shapeOf(breakpoint)}`);
  return [
    [kind, placeOf(breakpoint), breakpoint.kind === "line" ? String(lineOf(breakpoint)) : ""].filter(Boolean).join(" "),
    conditionsOf(breakpoint),
    breakpoint.message,
    breakpoint.reached > 0 ? t("debug.bp.reached", { count: breakpoint.reached }) : "",
    isShared(breakpoint)
      ? t("debug.bp.by", { author: breakpoint.author })
      : t("debug.bp.tool", { author: breakpoint.author }),
  ]
    .filter(Boolean)
    .join("\n");
}
