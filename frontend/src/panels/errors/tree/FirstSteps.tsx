import { isSample } from "../../../logic/project/sample";
import { openTour } from "../../../store/page/tour";
import { useDocuments } from "../../../store/project/documents";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";

/** What to do while no error was raised yet. */
export function FirstSteps() {
  const sample = useDocuments(({ files }) => isSample(files));
  return (
    <section className="firststeps" aria-label={t("errors.start.title")}>
      <div className="row apart">
        <h3>{t("errors.start.title")}</h3>
        {sample && (
          <button type="button" className="link" onClick={openTour}>
            {t("tour.open")}
          </button>
        )}
      </div>
      <ul>
        <li className="way">
          <Icon name="generated" small />
          <span>
            <b>{t("errors.start.pick")}</b> {t("errors.start.pick.rest")}
          </span>
        </li>
        <li className="way">
          <Icon name="handled" small />
          <span>
            <b>{t("errors.start.see")}</b> {t("errors.start.see.rest")}
          </span>
        </li>
        <li className="way">
          <Icon name="keyboard" small />
          <span>
            <b>{t("errors.start.key")}</b> {t("errors.start.key.rest")}
          </span>
        </li>
      </ul>
    </section>
  );
}
