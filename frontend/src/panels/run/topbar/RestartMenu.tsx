import { useState } from "react";
import { restart, rollBack } from "../../../store/debug/run";
import { useForbidden, usePlc } from "../../../store/plc/plc";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { MenuButton, type MenuItem } from "../../../ui/Menu";
import type { RestartKind } from "../../../wire/types";
import { NewRun } from "./NewRun";

const KINDS: readonly RestartKind[] = ["cold", "warm", "power"];

/** The kinds of restart, each with what it keeps; a new run; and the roll back to the previous program. */
export function RestartMenu() {
  const forbidden = useForbidden("newrun");
  const noRestart = useForbidden("restart");
  const noChange = useForbidden("change");
  const previous = usePlc((plc) => plc.state?.previous_version ?? null);
  const [asking, setAsking] = useState(false);
  const noWayBack = noChange ?? (previous === null ? t("restart.rollback.none") : null);
  const items = (): MenuItem[] => [
    ...KINDS.map(
      (kind): MenuItem => ({
        label: t(`restart.${kind}`),
        icon: kind === "power" ? "off" : "refresh",
        hint: noRestart ?? t(`restart.${kind}.hint`),
        disabled: noRestart !== null,
        onSelect: () => void restart(kind),
      }),
    ),
    {
      label: t("newrun.menu"),
      icon: "init",
      hint: t("newrun.menu.hint"),
      separated: true,
      onSelect: () => setAsking(true),
    },
    {
      label: t("restart.rollback"),
      icon: "past",
      hint: noWayBack ?? t("restart.rollback.hint", { version: previous ?? "" }),
      separated: true,
      disabled: noWayBack !== null,
      onSelect: () => void rollBack(),
    },
  ];
  return (
    <>
      <MenuButton
        label={t("restart.menu")}
        title={forbidden ?? undefined}
        className="ib"
        disabled={forbidden !== null}
        items={items}
      >
        <Icon name="refresh" />
      </MenuButton>
      {asking && <NewRun onClose={() => setAsking(false)} />}
    </>
  );
}
