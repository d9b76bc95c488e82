import type { ErrorStatus, ErrorWay } from "../logic/errors/catalogue";
import { t } from "../text";
import { StateWord } from "./StateWord";
import { STATUS_ICONS } from "./statuses";

interface Props {
  status: ErrorStatus;
  swept: boolean;
  /** Of what is cleared: recovered at the simulator, or cleared in the device's own way. */
  way?: ErrorWay;
}

/** Whether an error is present, was, or never was on this PLC; `swept`: then a sweep raised it in runs of its own. */
export function StatusWord({ status, swept, way }: Props) {
  if (swept)
    return <StateWord tone="never" icon="refresh" word={t("errors.status.swept")} title={t("history.swept")} />;
  const word = status === "cleared" && way ? t(`errors.way.${way}`) : t(`errors.status.${status}`);
  return <StateWord tone={status} icon={STATUS_ICONS[status]} word={word} />;
}
