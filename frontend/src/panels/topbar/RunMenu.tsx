import { useState } from "react";
import { t } from "../../logic/text";
import { runUntilAgain, useRun } from "../../store/run";
import { Icon } from "../../ui/Icon";
import { MenuButton } from "../../ui/Menu";
import { RunScans } from "./RunScans";
import { RunUntil } from "./RunUntil";

type Asking = "scans" | "until" | null;

/** Runs that end by themselves: after so many scans, or where a condition holds. */
export function RunMenu({ disabled }: { disabled: boolean }) {
  const [asking, setAsking] = useState<Asking>(null);
  const conditions = useRun((run) => run.conditions);
  return (
    <>
      <MenuButton
        label={t("run.more")}
        className="ib"
        disabled={disabled}
        items={() => [
          { label: t("run.scans"), icon: "scan", onSelect: () => setAsking("scans") },
          { label: t("run.until"), icon: "until", onSelect: () => setAsking("until") },
          ...conditions.map((condition, index) => ({
            label: t("run.until.last", { condition }),
            separated: index === 0,
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
