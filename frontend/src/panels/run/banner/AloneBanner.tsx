import { grouped } from "../../../logic/format/numbers";
import { endLook, lookAlone, putAwayLookTrouble, useAlone } from "../../../store/plc/alone";
import { useBench } from "../../../store/plc/bench";
import { answerTravel, useTimeline } from "../../../store/plc/timeline";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";

/** Asks who goes to the past while others use the PLC; and says that one looks alone, with the way back. */
export function AloneBanner() {
  const asking = useTimeline((run) => run.asking);
  const { looks, busy, trouble } = useAlone();
  const instance = useBench((bench) => bench.instance);
  const look = instance ? looks[instance.id] : undefined;
  const origin = useBench(({ app }) => app?.instances.find(({ id }) => id === look?.of)?.name);
  return (
    <>
      {trouble !== null && (
        <div className="banner stale" role="alert">
          <Icon name="warning" />
          <span className="grow">{t("alone.trouble", { message: trouble })}</span>
          <button type="button" className="btn sm" onClick={putAwayLookTrouble}>
            {t("link.read")}
          </button>
        </div>
      )}
      {asking !== null && (
        <section className="banner info" aria-label={t("alone.ask.label")}>
          <Icon name="past" />
          <span className="grow">
            <b>{t("alone.ask.title", { scan: grouped(asking.scan) })}</b>{" "}
            <span className="muted">{t("alone.ask.about")}</span>
          </span>
          <button type="button" className="btn quiet sm" onClick={() => answerTravel(false)}>
            {t("link.not")}
          </button>
          <button type="button" className="btn sm" onClick={() => answerTravel(true)}>
            {t("alone.everybody")}
          </button>
          <button type="button" className="btn past sm" disabled={busy} onClick={() => void lookAlone(asking.scan)}>
            {t("alone.look")}
          </button>
        </section>
      )}
      {look !== undefined && (
        <section className="banner past" aria-label={t("alone.label")}>
          <Icon name="branch" />
          <span className="grow">
            <b>{t("alone.title", { name: origin ?? "", scan: grouped(look.scan) })}</b>{" "}
            <span className="muted">{t("alone.about")}</span>
          </span>
          <button type="button" className="btn past sm" disabled={busy} onClick={() => void endLook()}>
            {t("alone.end", { name: origin ?? "" })}
          </button>
        </section>
      )}
    </>
  );
}
