import { grouped } from "../../logic/format/numbers";
import { cancelRetrospective, useTraces } from "../../store/trace/traces";
import { t } from "../../text";
import { Icon } from "../../ui/Icon";

/** Retrospective traces that are being computed: their progress, and a Cancel button. */
export function Retrospectives() {
  const retrospectives = useTraces((traces) => traces.retrospectives);
  return retrospectives.map(({ id, done, of, by }) => (
    <div key={id} className="trretro" role="status">
      <Icon name="past" small />
      <span className="nowrap">{t("trace.retrospective.progress", { done: grouped(done), of: grouped(of), by })}</span>
      <progress value={done} max={of} aria-label={t("trace.retrospective")} />
      <button type="button" className="btn quiet sm" onClick={() => void cancelRetrospective(id)}>
        {t("cancel")}
      </button>
    </div>
  ));
}
