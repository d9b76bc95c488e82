import { useState } from "react";
import { SPEEDS, setSpeed, speedName } from "../../../store/debug/run";
import { useForbidden, usePlc } from "../../../store/plc/plc";
import { t } from "../../../text";
import { AskName } from "../../../ui/AskName";
import { Icon } from "../../../ui/Icon";
import { MenuButton, type MenuItem } from "../../../ui/Menu";

/** The speed of PLC time, relative to real time. */
export function SpeedMenu() {
  const speed = usePlc((plc) => plc.state?.speed ?? 1);
  const forbidden = useForbidden("run");
  const [asking, setAsking] = useState(false);
  const known = SPEEDS.some((value) => value === speed);
  const items = (): MenuItem[] => [
    ...SPEEDS.map((value) => ({
      label: speedName(value),
      hint: value === 0 ? t("run.asfast") : value === 1 ? t("run.realtime") : undefined,
      checked: value === speed,
      onSelect: () => void setSpeed(value),
    })),
    {
      label: t("run.factor.menu"),
      hint: known ? undefined : speedName(speed),
      checked: !known,
      separated: true,
      onSelect: () => setAsking(true),
    },
  ];

  async function choose(text: string): Promise<void> {
    const factor = Number(text.replace(",", ".").replace(/^[x×]/i, ""));
    if (!(factor >= 0.01 && factor <= 1000)) throw new Error(t("run.factor.bad"));
    await setSpeed(factor);
  }

  return (
    <>
      <MenuButton
        label={t("run.speed", { speed: speedName(speed) })}
        title={forbidden ?? undefined}
        className="btn quiet sm speed"
        disabled={forbidden !== null}
        items={items}
      >
        <Icon name="clock" small />
        <span className="mono">{speedName(speed)}</span>
        <Icon name="chev-d" small />
      </MenuButton>
      {asking && (
        <AskName
          title={t("run.factor.title")}
          about={t("run.factor.about")}
          label={t("run.factor")}
          action={t("run.factor.do")}
          initial={speed === 0 ? "1" : String(speed)}
          onName={choose}
          onClose={() => setAsking(false)}
        />
      )}
    </>
  );
}
