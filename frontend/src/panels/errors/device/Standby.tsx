import { useCatalogue } from "../../../store/errors/catalogue";
import { repairStandby } from "../../../store/errors/device";
import { useForbidden } from "../../../store/plc/plc";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import type { DeviceStandby } from "../../../wire/types";

interface Props {
  standby: DeviceStandby;
  /** Nothing is present: what failed can be repaired only then, as an error that is present is recovered. */
  clear: boolean;
}

/** Which CPU Unit of a device with two controls, and why the standby took over. */
export function Standby({ standby: { duplex, side, causes, time }, clear }: Props) {
  const { byId } = useCatalogue();
  const forbidden = useForbidden("errors");
  const names = causes.map((id) => byId.get(id)?.name ?? id).join(", ");
  const about = t(duplex ? "device.standby.duplex" : "device.standby.simplex", { side: t(`device.standby.${side}`) });
  return (
    <section aria-label={t("device.standby")}>
      <h2>{t("device.standby")}</h2>
      <div className="row wrap none">
        <p className={`st ${duplex ? "running" : "halted"}`}>
          <Icon name={duplex ? "handled" : "warning"} small />
          <span>
            {about} {names && t("device.standby.why", { time: time || "–", causes: names })}
          </span>
        </p>
        {!duplex && clear && (
          <button
            type="button"
            className="btn sm"
            disabled={forbidden !== null}
            title={forbidden ?? t("device.standby.back.about")}
            onClick={() => void repairStandby()}
          >
            {t("device.standby.back")}
          </button>
        )}
      </div>
    </section>
  );
}
