import { showCampaigns } from "../../../store/verify/campaigns";
import { t } from "../../../text";

/** What a disturbance is, where none is defined. */
export function NoneYet() {
  return (
    // biome-ignore lint/a11y/noNoninteractiveTabindex: it scrolls where the window is low, and has nothing else that takes the focus.
    <section className="disturbnone" aria-label={t("disturb.none")} tabIndex={0}>
      <h3>{t("disturb.none")}</h3>
      <p className="muted">{t("disturb.none.about")}</p>
      <button type="button" className="btn sm" onClick={showCampaigns}>
        {t("campaign.show")}
      </button>
    </section>
  );
}
