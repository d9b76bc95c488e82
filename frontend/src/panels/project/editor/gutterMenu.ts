/** The menu of a line: its breakpoints, and running to the line. */
import { conditionsOf, isShared, PLAIN } from "../../../logic/debug/breakpoints";
import { permits } from "../../../logic/debug/stepping";
import {
  addBreakpoint,
  type Editing,
  editBreakpoint,
  enableBreakpoints,
  removeBreakpoints,
  wantedOf,
} from "../../../store/debug/debug";
import { runTo } from "../../../store/debug/stepping";
import { usePlc } from "../../../store/plc/plc";
import { t } from "../../../text";
import type { MenuItem } from "../../../ui/Menu";
import type { BreakpointInfo } from "../../../wire/types";

interface At {
  path: string;
  /** The line in the shown text, and in the built one. */
  line: number;
  built: number;
  here: readonly BreakpointInfo[];
}

export function lineMenu({ path, line, built, here }: At): MenuItem[] {
  const mine = here.filter(isShared);
  const ask = (does: Editing["does"]) => () =>
    editBreakpoint({ file: path, line, wanted: { ...PLAIN, file: path, line: built }, id: null, does });
  return [
    ...mine.flatMap((known) => existing(known, line, mine.length > 1)),
    ...(mine.length > 0
      ? []
      : [
          {
            label: t("debug.bp.add"),
            icon: "bp" as const,
            hint: "F9",
            onSelect: () => void addBreakpoint({ file: path, line: built }),
          },
        ]),
    { label: t("debug.bp.add.if"), icon: "bp-cond", separated: mine.length > 0, onSelect: ask("halt") },
    { label: t("debug.bp.add.log"), icon: "bp-log", onSelect: ask("log") },
    { label: t("debug.bp.add.assign"), icon: "bp-assign", onSelect: ask("assign") },
    {
      label: t("debug.runhere"),
      icon: "until",
      hint: "Ctrl+F10",
      separated: true,
      disabled: !permits(usePlc.getState().state, "next"),
      onSelect: () => void runTo(path, built),
    },
  ];
}

/** The label of a breakpoint; its conditions distinguish it from others at the line. */
function existing(known: BreakpointInfo, line: number, several: boolean): MenuItem[] {
  const said = several ? ` (${conditionsOf(known) || `#${known.id}`})` : "";
  return [
    {
      label: t("debug.bp.edit") + said,
      onSelect: () =>
        editBreakpoint({ file: known.file, line, wanted: wantedOf(known), id: known.id, does: doesOf(known) }),
    },
    {
      label: t(known.enabled ? "debug.bp.disable" : "debug.bp.enable") + said,
      onSelect: () => void enableBreakpoints(!known.enabled, [known.id]),
    },
    { label: t("debug.bp.remove") + said, icon: "trash", onSelect: () => void removeBreakpoints([known.id]) },
  ];
}

const doesOf = ({ log, assign }: BreakpointInfo): Editing["does"] => (log ? "log" : assign ? "assign" : "halt");
