import { forgetTaken, heldByOther, useForces } from "../../../store/watch/forces";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";

/** Forces of yours that somebody else replaced or ended: who, which, from what, and to what while that is forced. */
export function TakenBanner() {
  const taken = useForces((forces) => forces.taken);
  useForces((forces) => forces.held);
  return [...taken.values()].map(({ path, by, mine }) => {
    const now = heldByOther(path);
    return (
      <div
        key={path}
        className="banner info"
        role="status"
        aria-label={t(now ? "force.taken.label" : "force.ended.label")}
      >
        <Icon name="forced" />
        <span className="grow">
          {now
            ? t("force.taken", { path, by: now.author, value: now.value, mine })
            : t("force.ended", { path, by, mine })}
        </span>
        <button type="button" className="btn sm" onClick={() => forgetTaken(path)}>
          {t("force.taken.read")}
        </button>
      </div>
    );
  });
}
