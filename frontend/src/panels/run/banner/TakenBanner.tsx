import { forgetTaken, useForces } from "../../../store/watch/forces";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";

/** Forces of yours that somebody else replaced or ended: who, which, from what to what. */
export function TakenBanner() {
  const taken = useForces((forces) => forces.taken);
  return [...taken.values()].map(({ path, by, value, mine }) => (
    <div
      key={path}
      className="banner info"
      role="status"
      aria-label={t(value === null ? "force.ended.label" : "force.taken.label")}
    >
      <Icon name="forced" />
      <span className="grow">
        {value === null ? t("force.ended", { path, by, mine }) : t("force.taken", { path, by, value, mine })}
      </span>
      <button type="button" className="btn sm" onClick={() => forgetTaken(path)}>
        {t("force.taken.read")}
      </button>
    </div>
  ));
}
