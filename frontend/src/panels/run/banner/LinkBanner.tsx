import { grouped } from "../../../logic/format/numbers";
import { answerLink, putAwayLinkTrouble, useLinks } from "../../../store/plc/links";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";

/** About the opened address: why it could not be followed, or whether to go to its scan although others use the PLC. */
export function LinkBanner() {
  const { question, trouble } = useLinks();
  return (
    <>
      {trouble !== null && (
        <div className="banner stale" role="alert">
          <Icon name="warning" />
          <span className="grow">{trouble}</span>
          <button type="button" className="btn sm" onClick={putAwayLinkTrouble}>
            {t("link.read")}
          </button>
        </div>
      )}
      {question !== null && (
        <section className="banner info" aria-label={t("link.label")}>
          <Icon name="link" />
          <span className="grow">
            <b>{t("link.ask.title", { scan: grouped(question) })}</b>{" "}
            <span className="muted">{t("link.ask.about")}</span>
          </span>
          <button type="button" className="btn sm" onClick={() => answerLink(false)}>
            {t("link.not")}
          </button>
          <button type="button" className="btn past sm" onClick={() => answerLink(true)}>
            {t("link.ask", { scan: grouped(question) })}
          </button>
        </section>
      )}
    </>
  );
}
