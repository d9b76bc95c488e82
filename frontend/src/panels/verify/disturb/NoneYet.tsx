import { t } from "../../../text";

/** What a disturbance is, where none is defined. */
export function NoneYet() {
  return (
    <section className="disturbnone" aria-label={t("disturb.none")}>
      <h3>{t("disturb.none")}</h3>
      <p className="muted">{t("disturb.none.about")}</p>
    </section>
  );
}
