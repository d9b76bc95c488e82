import { grouped } from "../../logic/format/numbers";
import { cancelFlight, useTraces } from "../../store/trace/traces";
import { t } from "../../text";
import { Icon } from "../../ui/Icon";

/** Retrospective traces that are being computed: their progress, and a Cancel button. */
export function Flights() {
  const flights = useTraces((traces) => traces.flights);
  return flights.map(({ id, done, of, by }) => (
    <div key={id} className="trflight" role="status">
      <Icon name="past" small />
      <span className="nowrap">{t("trace.flight.progress", { done: grouped(done), of: grouped(of), by })}</span>
      <progress value={done} max={of} aria-label={t("trace.flight")} />
      <button type="button" className="btn quiet sm" onClick={() => void cancelFlight(id)}>
        {t("cancel")}
      </button>
    </div>
  ));
}
