/** Breakpoints as people see them: drawing, place and description. */

import { t } from "../../text";
import type { BreakpointInfo, Pou } from "../../wire/types";
import { pouAt } from "../plc/sourceLines";

/** A drawing of the gutter: filled halts, hollow is disabled, dashed is not in the program. */
type BreakpointShape = "bp" | "bp-cond" | "bp-log" | "bp-assign" | "bp-data" | "bp-off" | "bp-unbound";

/** The properties of a breakpoint that a person chooses. */
export type Wanted = Pick<
  BreakpointInfo,
  | "kind"
  | "enabled"
  | "file"
  | "line"
  | "column"
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
  column: 0,
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

/** The list that all browsers share; each other group belongs to one tool. */
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

/** Its line in the built text. */
export const lineOf = (breakpoint: BreakpointInfo) => breakpoint.at_line || breakpoint.line;

/** Where the breakpoint halts: the POU around its line, a variable, an error, a scan. While the declarations are not known, the file. */
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

/** What restricts the breakpoint, in short: `if jam.Q`, `3rd time`, `off`. */
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

/** The whole description, for a tooltip. */
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
