import { t } from "../../logic/text";
import { useForbidden, useOnline, usePlc } from "../../store/plc";
import { runAction, singleScan } from "../../store/run";
import { stepBack, useTimeline } from "../../store/timeline";
import { IconButton } from "../../ui/IconButton";
import { RestartMenu } from "./RestartMenu";
import { RunMenu } from "./RunMenu";
import { SpeedMenu } from "./SpeedMenu";

/** Back, continue, pause, single scan, restart, speed: each at its place, usable when it means something. */
export function RunControls() {
  const state = usePlc((plc) => plc.state);
  const online = useOnline();
  const forbidden = useForbidden("run");
  const first = useTimeline((timeline) => timeline.info?.first_scan ?? 0);
  const past = online && state?.past != null;
  const running = forbidden === null && state?.state === "running";
  const paused = forbidden === null && state?.state === "paused";
  return (
    <>
      <div className="runset" role="toolbar" aria-label={t("run.label")}>
        <IconButton
          icon="step-back"
          label={t("run.back")}
          hint="Shift+F8"
          disabled={!(past || paused) || (state?.scan ?? 0) <= first}
          onClick={stepBack}
        />
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
          label={t(past ? "run.scan.past" : "run.scan")}
          hint="F8"
          disabled={!(past || paused)}
          onClick={singleScan}
        />
        <RunMenu disabled={!(running || paused)} />
        <span className="vr" />
        <RestartMenu />
      </div>
      <SpeedMenu />
    </>
  );
}
