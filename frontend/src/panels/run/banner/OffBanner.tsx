import { useState } from "react";
import { messageOf } from "../../../logic/format/messageOf";
import { useBench } from "../../../store/plc/bench";
import { changeInstance } from "../../../store/plc/instances";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";

/** Somebody switched this PLC off: nothing is lost, and it can be switched on again. */
export function OffBanner() {
  const instance = useBench((bench) => bench.instance);
  const [refused, setRefused] = useState("");
  if (!instance) return null;
  return (
    <div className="banner stale" role="alert">
      <Icon name="off" />
      <span className="grow">
        <b>{t("off.title", { name: instance.name })}</b> <span className="muted">{refused || t("off.about")}</span>
      </span>
      <button
        type="button"
        className="btn sm"
        title={t("instances.power.on.hint")}
        onClick={() =>
          changeInstance(instance, { power: true }).catch((error: unknown) => setRefused(messageOf(error)))
        }
      >
        {t("instances.power.on")}
      </button>
    </div>
  );
}
