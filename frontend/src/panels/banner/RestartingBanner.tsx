import { t } from "../../logic/text";
import { restart } from "../../store/run";
import { Icon } from "../../ui/Icon";
import type { InstanceState } from "../../wire/types";

/** The process of the PLC died: it is being started again, or that did not work either. Or it does not answer. */
export function RestartingBanner({ state }: { state: InstanceState }) {
  const failed = state.state === "failed";
  const silent = state.state === "silent";
  return (
    <div className={`banner ${failed ? "fatal" : "stale"}`} role="alert">
      <Icon name={failed ? "error" : silent ? "lost" : "refresh"} />
      <span className="grow">
        <b>{failed ? t("failed.title") : silent ? t("silent.title") : t("restarting.title")}</b>{" "}
        <span className="muted">{silent ? t("silent.about") : state.message || t("restarting.about")}</span>
      </span>
      {failed && (
        <button type="button" className="btn danger sm" onClick={() => void restart("cold")}>
          {t("restart.menu")}
        </button>
      )}
    </div>
  );
}
