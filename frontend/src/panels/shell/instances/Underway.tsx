import { percent } from "../../../logic/format/numbers";
import type { Transfer } from "../../../store/plc/instances";
import { t } from "../../../text";

/** A run file on its way: what, and how far it got. */
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
