import { chooseMode } from "../../../store/debug/run";
import { useForbidden, usePlc } from "../../../store/plc/plc";
import { t } from "../../../text";
import { Segments } from "../../../ui/Segments";

const MODES = ["PROGRAM", "MONITOR", "RUN"] as const;

/** PROGRAM, MONITOR, RUN: the chosen mode. The real state of the PLC is shown beside it. */
export function ModeSwitch() {
  const mode = usePlc((plc) => plc.state?.mode ?? null);
  const forbidden = useForbidden("mode");
  return (
    <Segments
      label={t("mode.label")}
      look="caps"
      acts
      value={mode}
      options={MODES.map((name) => ({ value: name, word: name, title: t(`mode.${name}.about`) }))}
      disabled={forbidden}
      onChoose={(wanted) => void chooseMode(wanted)}
    />
  );
}
