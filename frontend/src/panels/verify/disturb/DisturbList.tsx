import { grouped } from "../../../logic/format/numbers";
import { useForbidden } from "../../../store/plc/plc";
import { showCampaigns } from "../../../store/verify/campaigns";
import { calm, useDisturb } from "../../../store/verify/disturb";
import { t } from "../../../text";
import { StateWord } from "../../../ui/StateWord";
import type { DisturbanceInfo } from "../../../wire/types";

/** The disturbances that are not over, or were never injected: what, when next, how often so far, by whom. */
export function DisturbList() {
  const disturbances = useDisturb((state) => state.disturbances);
  const forbidden = useForbidden("errors");
  const locked = { disabled: forbidden !== null, title: forbidden ?? undefined };
  return (
    <section className="disturblist" aria-label={t("disturb.list")}>
      <div className="row">
        <b className="grow">{t("disturb.count", { count: disturbances.length })}</b>
        <button type="button" className="btn quiet sm" onClick={showCampaigns}>
          {t("campaign.show")}
        </button>
        {disturbances.length > 1 && (
          <button type="button" className="btn quiet sm" {...locked} onClick={() => void calm(null)}>
            {t("disturb.takeback.all")}
          </button>
        )}
      </div>
      <ul>
        {disturbances.map((disturbance) => (
          <Line key={disturbance.id} disturbance={disturbance} locked={locked} />
        ))}
      </ul>
    </section>
  );
}

interface LineProps {
  disturbance: DisturbanceInfo;
  locked: { disabled: boolean; title: string | undefined };
}

const STATES = {
  waiting: ["recording", "clock"],
  active: ["warning", "disturbance"],
  missed: ["stopped", "minus"],
} as const;

function Line({ disturbance: { id, text, kind, by, state, fired, next_scan, why }, locked }: LineProps) {
  const [tone, icon] = STATES[state];
  const facts = [
    state === "missed"
      ? t("disturb.missed.why", { why })
      : fired === 0
        ? t("disturb.fired.not")
        : t("disturb.fired", { count: grouped(fired) }),
    next_scan === null ? "" : t("disturb.next", { scan: grouped(next_scan) }),
    t("disturb.by", { by }),
  ];
  return (
    <li data-disturbance={id} title={`${t(`disturb.kind.${kind}`)}: ${text}`}>
      <StateWord tone={tone} icon={icon} word={t(`disturb.${state}`)} />
      <span className="grow">
        <p>{text}</p>
        <small className="faint">{facts.filter(Boolean).join(" · ")}</small>
      </span>
      <button
        type="button"
        className="btn sm"
        aria-label={t("disturb.takeback.of", { text })}
        {...locked}
        onClick={() => void calm(id)}
      >
        {t("disturb.takeback")}
      </button>
    </li>
  );
}
