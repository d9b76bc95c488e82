import { forgetTaken, useForces } from "../../../store/watch/forces";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";

/** Forces of yours that somebody else replaced: who, which, from what to what. */
export function TakenBanner() {
  const taken = useForces((forces) => forces.taken);
  return [...taken.values()].map((each) => (
    <div key={each.path} className="banner info" role="status" aria-label={t("force.taken.label")}>
      <Icon name="forced" />
      <span className="grow">{t("force.taken", each)}</span>
      <button type="button" className="btn sm" onClick={() => forgetTaken(each.path)}>
        {t("force.taken.read")}
      </button>
    </div>
  ));
}
