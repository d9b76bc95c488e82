import { useState } from "react";
import { PLAIN, type Wanted } from "../../../logic/debug/breakpoints";
import { addBreakpoint } from "../../../store/debug/debug";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { MenuButton } from "../../../ui/Menu";
import { EditBreakpoint } from "./EditBreakpoint";

/** Breakpoints that belong to no line: at a variable, an error, a scan, run-time errors and subrange violations. */
export function AddBreakpoint() {
  const [asking, setAsking] = useState<Wanted["kind"] | null>(null);
  return (
    <>
      <MenuButton
        label={t("debug.bp.new")}
        className="ib sm"
        items={() => [
          { label: t("debug.new.data"), icon: "bp-data", onSelect: () => setAsking("data") },
          { label: t("debug.new.error"), icon: "generated", onSelect: () => setAsking("error") },
          { label: t("debug.new.scan"), icon: "scan", onSelect: () => setAsking("scan") },
          {
            label: t("debug.new.violation"),
            icon: "warning",
            separated: true,
            onSelect: () => void addBreakpoint({ kind: "violation" }),
          },
          { label: t("debug.new.trap"), icon: "fatal", onSelect: () => void addBreakpoint({ kind: "trap" }) },
        ]}
      >
        <Icon name="plus" />
      </MenuButton>
      {asking && <EditBreakpoint known={{ ...PLAIN, kind: asking }} onClose={() => setAsking(null)} />}
    </>
  );
}
