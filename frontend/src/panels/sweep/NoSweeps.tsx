import { t } from "../../logic/text";
import { Icon, type IconName } from "../../ui/Icon";

/** No sweep yet: what one is for, and how to come to one. */
export function NoSweeps() {
  return (
    <div className="empty">
      <div>
        <h3>{t("sweep.empty.title")}</h3>
        <p>{t("sweep.empty.about")}</p>
      </div>
      <div className="ways">
        <Way icon="plus" strong={t("sweep.empty.keep")} rest={t("sweep.empty.keep.rest")} />
        <Way icon="generated" strong={t("sweep.empty.run")} rest={t("sweep.empty.run.rest")} />
        <Way icon="unhandled" strong={t("sweep.empty.find")} rest={t("sweep.empty.find.rest")} />
      </div>
    </div>
  );
}

function Way({ icon, strong, rest }: { icon: IconName; strong: string; rest: string }) {
  return (
    <div className="way">
      <Icon name={icon} />
      <span>
        <b>{strong}</b> {rest}
      </span>
    </div>
  );
}
