import { useState } from "react";
import { messageOf } from "../../../logic/format/messageOf";
import { useBench } from "../../../store/plc/bench";
import { changeInstance } from "../../../store/plc/instances";
import { useForbidden } from "../../../store/plc/plc";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import type { InstanceState } from "../../../wire/types";

/** The process of the PLC ended: it is being started again, or that failed. Or it does not answer. */
export function RestartingBanner({ state }: { state: InstanceState }) {
  const silent = state.state === "silent";
  if (state.state === "failed") return <FailedBanner state={state} />;
  return (
    <div className="banner stale" role="alert">
      <Icon name={silent ? "lost" : "refresh"} />
      <span className="grow">
        <b>{silent ? t("silent.title") : t("restarting.title")}</b>{" "}
        <span className="muted">{silent ? t("silent.about") : state.message || t("restarting.about")}</span>
      </span>
    </div>
  );
}

/** Without a process the PLC cannot take a restart: where it can be started at all, the button switches it on again. */
function FailedBanner({ state }: { state: InstanceState }) {
  const instance = useBench((bench) => bench.instance);
  const hopeless = useForbidden("newrun") !== null;
  const [refused, setRefused] = useState("");
  return (
    <div className="banner fatal" role="alert">
      <Icon name="error" />
      <span className="grow">
        <b>{t(hopeless ? "failed.hopeless" : "failed.title")}</b>{" "}
        <span className="muted">{refused || state.message}</span>
      </span>
      {instance && !hopeless && (
        <button
          type="button"
          className="btn danger sm"
          title={t("instances.power.on.hint")}
          onClick={() =>
            changeInstance(instance, { power: true }).catch((error: unknown) => setRefused(messageOf(error)))
          }
        >
          {t("failed.start")}
        </button>
      )}
    </div>
  );
}
