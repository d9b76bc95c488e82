import { percent } from "../../../logic/format/numbers";
import type { Transfer } from "../../../store/plc/instances";
import { t } from "../../../text";

/** The transfer of a run file: which, and its progress. */
export function Underway({ transfer }: { transfer: Transfer }) {
  const what = t(transfer.text === "import" ? "instances.importing" : "instances.exporting", { name: transfer.name });
  const share = transfer.share === null ? "" : percent(Math.floor(transfer.share * 100));
  return (
    <span className="row grow">
      <span className="cut">{t("instances.intransit", { what, share })}</span>
      <progress className="grow" aria-label={what} value={transfer.share ?? undefined} max={1} />
    </span>
  );
}
