import { haltPlace } from "../../../logic/plc/halted";
import { type ShownState, showState } from "../../../logic/plc/plcstate";
import { isPaced } from "../../../logic/verify/verify";
import { useStepping } from "../../../store/debug/stepping";
import { useBench } from "../../../store/plc/bench";
import { useOnline, usePlc } from "../../../store/plc/plc";
import { useVerify } from "../../../store/verify/verify";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";

/** A project without an instance is not shown as a lost connection. */
const noPlc = (): ShownState => ({
  tone: "stopped",
  icon: "off",
  word: t("state.none"),
  detail: t("state.none.detail"),
});

/** The real state of the PLC, as icon, word and colour. */
export function PlcState() {
  const state = usePlc((plc) => plc.state);
  const online = useOnline();
  const searching = useStepping((stepping) => stepping.searching);
  const missing = useBench((bench) => bench.project !== null && bench.instance === null);
  const shown = missing ? noPlc() : showState(state, online);
  const waits = useVerify(({ verifications }) => verifications.some(isPaced));
  const detail = searching
    ? t("state.searching")
    : waits && state?.state === "paused"
      ? t("verify.holds")
      : shown.detail;
  const halt = online ? state?.halt : null;
  const short = searching ? undefined : shown.short;
  const whole = state?.state === "starting" ? detail : state?.message || detail;
  return (
    <div
      className={`plcstate ${shown.tone}`}
      role="status"
      aria-label={t("state.label")}
      aria-busy={searching}
      title={halt ? [halt.text, haltPlace(halt)].filter(Boolean).join("\n") : whole}
    >
      <Icon name={shown.icon} />
      <span className="two">
        <span className="cut">{shown.word}</span>
        <span className={`cut${short === undefined ? "" : " ifwide"}`}>{detail}</span>
        {short !== undefined && <span className="cut ifnarrow">{short}</span>}
      </span>
    </div>
  );
}
