import { useEffect } from "react";
import { endFollowing, usePeople } from "../../../store/project/people";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";

/** Keys that do nothing by themselves. */
const QUIET = ["Shift", "Control", "Alt", "Meta"];

/** Whom you follow. Whatever you do yourself ends it. */
export function FollowBanner() {
  const person = usePeople(({ people, following }) => people.find(({ id }) => id === following));
  const following = person !== undefined;
  useEffect(() => {
    if (!following) return;
    const onKey = ({ key }: KeyboardEvent) => QUIET.includes(key) || endFollowing();
    addEventListener("keydown", onKey, true);
    addEventListener("pointerdown", endFollowing, true);
    addEventListener("wheel", endFollowing, { capture: true, passive: true });
    return () => {
      removeEventListener("keydown", onKey, true);
      removeEventListener("pointerdown", endFollowing, true);
      removeEventListener("wheel", endFollowing, true);
    };
  }, [following]);
  if (!person) return null;
  return (
    <section className="banner info" aria-label={t("follow.label")}>
      <Icon name="eye" />
      <span className="grow">
        <b>{t("follow.title", person)}</b> <span className="muted">{t("follow.about")}</span>
      </span>
      <button type="button" className="btn sm" onClick={endFollowing}>
        {t("follow.end")}
      </button>
    </section>
  );
}
