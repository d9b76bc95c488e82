import { permits } from "../../../logic/debug/stepping";
import { runAction, singleScan } from "../../../store/debug/run";
import { step, useStepping } from "../../../store/debug/stepping";
import { useForbidden, useOnline, usePlc } from "../../../store/plc/plc";
import { stepBack, useTimeline } from "../../../store/plc/timeline";
import { t } from "../../../text";
import { IconButton } from "../../../ui/IconButton";
import { RestartMenu } from "./RestartMenu";
import { RunMenu } from "./RunMenu";
import { SpeedMenu } from "./SpeedMenu";

/** Back, continue or pause, steps, single scan, restart, speed: each has a fixed place, and is enabled when it is possible. */
export function RunControls() {
  const state = usePlc((plc) => plc.state);
  const online = useAble();
  const forbidden = useForbidden("run");
  const halted = online && state?.halt != null;
  const past = online && state?.past != null;
  const running = forbidden === null && state?.state === "running";
  const paused = forbidden === null && online && state?.state === "paused";
  const runs = running || paused || halted;
  return (
    <>
      <div className="runset" role="toolbar" aria-label={t("run.label")}>
        <Back />
        {running ? (
          <IconButton icon="pause" label={t("run.pause")} hint="F5" onClick={() => void runAction("pause")} />
        ) : (
          <IconButton
            icon="play"
            label={t("run.continue")}
            hint="F5"
            className={paused || halted ? "go" : ""}
            disabled={!paused && !halted}
            onClick={() => void (halted ? step("continue") : runAction("continue"))}
          />
        )}
        <Steps />
        <span className="vr" />
        <IconButton
          icon="scan"
          label={t(past && !halted ? "run.scan.past" : "run.scan")}
          hint="F8"
          disabled={!(past || paused || halted)}
          onClick={singleScan}
        />
        <RunMenu disabled={!runs && !(online && permits(state, "reverseContinue"))} runs={runs} />
        <RestartMenu />
      </div>
      <SpeedMenu />
    </>
  );
}

/** Disabled while the PLC searches backwards. */
function useAble(): boolean {
  const searching = useStepping((stepping) => stepping.searching);
  return useOnline() && !searching;
}

/** Goes back one statement if the PLC is at a statement, or the program stopped at one; else one scan. */
function Back() {
  const state = usePlc((plc) => plc.state);
  const online = useAble();
  const first = useTimeline((timeline) => timeline.info?.first_scan ?? 0);
  if (state?.halt || state?.state === "trapped") {
    return (
      <IconButton
        icon="step-back"
        label={t("debug.back")}
        hint="Shift+F10"
        disabled={!online}
        onClick={() => void step("stepBack")}
      />
    );
  }
  const able = online && permits(state, "stepBack");
  return (
    <IconButton
      icon="step-back"
      label={t("run.back")}
      hint="Shift+F8"
      disabled={!able || (state?.scan ?? 0) <= first}
      onClick={stepBack}
    />
  );
}

const STEPS = [
  { command: "next", icon: "step-over", text: "debug.over", key: "F10" },
  { command: "stepIn", icon: "step-in", text: "debug.in", key: "F11" },
  { command: "stepOut", icon: "step-out", text: "debug.out", key: "Shift+F11" },
] as const;

function Steps() {
  const state = usePlc((plc) => plc.state);
  const online = useAble();
  return STEPS.map(({ command, icon, text, key }) => (
    <IconButton
      key={command}
      icon={icon}
      label={t(text)}
      hint={key}
      disabled={!online || !permits(state, command)}
      onClick={() => void step(command)}
    />
  ));
}
