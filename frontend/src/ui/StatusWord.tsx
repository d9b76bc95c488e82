import type { ErrorStatus } from "../logic/errors/catalogue";
import { t } from "../text";
import { StateWord } from "./StateWord";
import { STATUS_ICONS } from "./statuses";

/** Whether an error is present, was, or never was on this PLC; `swept`: then a sweep raised it in runs of its own. */
export function StatusWord({ status, swept }: { status: ErrorStatus; swept: boolean }) {
  if (swept)
    return <StateWord tone="never" icon="refresh" word={t("errors.status.swept")} title={t("history.swept")} />;
  return <StateWord tone={status} icon={STATUS_ICONS[status]} word={t(`errors.status.${status}`)} />;
}
