import { showState } from "../../logic/plcstate";
import { t } from "../../logic/text";
import { useOnline, usePlc } from "../../store/plc";
import { Icon } from "../../ui/Icon";

/** What the PLC really does now, as icon, word and colour. */
export function PlcState() {
  const state = usePlc((plc) => plc.state);
  const online = useOnline();
  const shown = showState(state, online);
  return (
    <div
      className={`plcstate ${shown.tone}`}
      role="status"
      aria-label={t("state.label")}
      title={state?.state === "starting" ? shown.detail : state?.message || shown.detail}
    >
      <Icon name={shown.icon} />
      <span className="two">
        <span className="cut">{shown.word}</span>
        <span className={`cut${shown.short === undefined ? "" : " ifwide"}`}>{shown.detail}</span>
        {shown.short !== undefined && <span className="cut ifnarrow">{shown.short}</span>}
      </span>
    </div>
  );
}
