import { t } from "../../logic/text";
import { useOnline, usePlc } from "../../store/plc";
import { runAction, SPEEDS, setSpeed, speedName } from "../../store/run";
import { Icon } from "../../ui/Icon";
import { IconButton } from "../../ui/IconButton";
import { MenuButton } from "../../ui/Menu";

/** Continue, pause, single scan, restart, speed: each at its place, usable when it means something. */
export function RunControls() {
  const state = usePlc((plc) => plc.state);
  const online = useOnline();
  const running = online && state?.state === "running";
  const paused = online && state?.state === "paused";
  const speed = state?.speed ?? 1;
  return (
    <>
      <div className="runset" role="toolbar" aria-label={t("run.label")}>
        <IconButton
          icon="play"
          label={t("run.continue")}
          hint="F5"
          className={paused ? "go" : ""}
          disabled={!paused}
          onClick={() => void runAction("continue")}
        />
        <IconButton
          icon="pause"
          label={t("run.pause")}
          hint="F5"
          disabled={!running}
          onClick={() => void runAction("pause")}
        />
        <IconButton
          icon="scan"
          label={t("run.scan")}
          hint="F8"
          disabled={!paused}
          onClick={() => void runAction("scan")}
        />
        <span className="vr" />
        <IconButton
          icon="refresh"
          label={t("run.restart")}
          hint="Ctrl+Shift+F5"
          disabled={!online}
          onClick={() => void runAction("restart")}
        />
      </div>
      <MenuButton
        label={t("run.speed", { speed: speedName(speed) })}
        className="btn quiet sm speed"
        disabled={!online}
        items={() =>
          SPEEDS.map((value) => ({
            label: speedName(value),
            hint: value === 0 ? t("run.asfast") : value === 1 ? t("run.realtime") : undefined,
            checked: value === speed,
            onSelect: () => void setSpeed(value),
          }))
        }
      >
        <Icon name="clock" small />
        <span className="mono">{speedName(speed)}</span>
        <Icon name="chev-d" small />
      </MenuButton>
    </>
  );
}
