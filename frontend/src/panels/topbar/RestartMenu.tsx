import { t } from "../../logic/text";
import { useForbidden } from "../../store/plc";
import { restart, rollBack } from "../../store/run";
import { Icon } from "../../ui/Icon";
import { MenuButton, type MenuItem } from "../../ui/Menu";
import type { RestartKind } from "../../wire/types";

const KINDS: readonly RestartKind[] = ["cold", "warm", "power"];

/** The ways to begin anew, each with what it keeps; and the way back to the program before. */
export function RestartMenu() {
  const forbidden = useForbidden("restart");
  const noChange = useForbidden("change");
  const items = (): MenuItem[] => [
    ...KINDS.map(
      (kind): MenuItem => ({
        label: t(`restart.${kind}`),
        icon: kind === "power" ? "off" : "refresh",
        hint: t(`restart.${kind}.hint`),
        onSelect: () => void restart(kind),
      }),
    ),
    {
      label: t("restart.rollback"),
      icon: "past",
      hint: noChange ?? t("restart.rollback.hint"),
      separated: true,
      disabled: noChange !== null,
      onSelect: () => void rollBack(),
    },
  ];
  return (
    <MenuButton
      label={t("restart.menu")}
      title={forbidden ?? undefined}
      className="ib"
      disabled={forbidden !== null}
      items={items}
    >
      <Icon name="refresh" />
    </MenuButton>
  );
}
