import { useState } from "react";
import { permits } from "../../../logic/debug/stepping";
import { caretPlace } from "../../../store/debug/debugKeys";
import { runUntilAgain, useRun } from "../../../store/debug/run";
import { runToCaret, step } from "../../../store/debug/stepping";
import { usePlc } from "../../../store/plc/plc";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { MenuButton } from "../../../ui/Menu";
import { RunScans } from "./RunScans";
import { RunUntil } from "./RunUntil";

type Asking = "scans" | "until" | null;

/** Runs with an end, and steps back; `runs` says whether the program can continue at all. */
export function RunMenu({ disabled, runs }: { disabled: boolean; runs: boolean }) {
  const [asking, setAsking] = useState<Asking>(null);
  const conditions = useRun((run) => run.conditions);
  const state = usePlc((plc) => plc.state);
  return (
    <>
      <MenuButton
        label={t("run.more")}
        className="ib"
        disabled={disabled}
        items={() => [
          { label: t("run.scans"), icon: "scan", disabled: !runs, onSelect: () => setAsking("scans") },
          { label: t("run.until"), icon: "until", disabled: !runs, onSelect: () => setAsking("until") },
          {
            label: t("debug.runcaret"),
            icon: "here",
            hint: "Ctrl+F10",
            disabled: !runs || caretPlace() === null,
            onSelect: runToCaret,
          },
          {
            label: t("debug.reverse"),
            icon: "reverse",
            hint: "Alt+F5",
            disabled: !permits(state, "reverseContinue"),
            onSelect: () => void step("reverseContinue"),
          },
          ...conditions.map((condition, index) => ({
            label: t("run.until.last", { condition }),
            separated: index === 0,
            disabled: !runs,
            onSelect: () => void runUntilAgain(condition),
          })),
        ]}
      >
        <Icon name="until" />
      </MenuButton>
      {asking === "scans" && <RunScans onClose={() => setAsking(null)} />}
      {asking === "until" && <RunUntil onClose={() => setAsking(null)} />}
    </>
  );
}
