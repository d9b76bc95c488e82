import { openTour } from "../store/page/tour";
import { t } from "../text";
import { Icon } from "../ui/Icon";

/** Shown in the place of the editors while no file is open. */
export function Start() {
  return (
    <section className="pane startpage" aria-label={t("start.label")}>
      <div className="way">
        <Icon name="folder" />
        <span>
          <b>{t("start.open")}</b> {t("start.open.rest")}
        </span>
      </div>
      <div className="way">
        <Icon name="plus" />
        <span>
          <b>{t("start.new")}</b> {t("start.new.rest")}
        </span>
      </div>
      <div className="way">
        <Icon name="help" />
        <span>
          <button type="button" className="link" onClick={openTour}>
            {t("tour.open")}
          </button>
        </span>
      </div>
    </section>
  );
}
