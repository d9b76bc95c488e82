import { resolveConflict } from "../../../store/project/documents";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { later } from "../../../ui/later";
import type { FileText } from "../../../wire/types";
import { afterWords } from "./loading";

const DiffView = later(() => afterWords(() => import("./DiffView")));

/** Somebody else saved first: both texts side by side, and a choice. Nothing is lost until the user chooses. */
export function Conflict({ path, theirs }: { path: string; theirs: FileText }) {
  return (
    <section className="conflict" aria-label={t("conflict.label")}>
      <div className="banner info" role="alert">
        <Icon name="info" />
        <span className="grow">
          <b>
            {theirs.version === 0
              ? t("deleted.meanwhile", { path })
              : t("conflict.title", { path, version: theirs.version, author: theirs.author })}
          </b>{" "}
          <span className="muted">{t("conflict.about")}</span>
        </span>
        <button type="button" className="btn sm" onClick={() => void resolveConflict(path, "theirs")}>
          {t("conflict.theirs")}
        </button>
        <button type="button" className="btn sm" onClick={() => void resolveConflict(path, "mine")}>
          {t("conflict.mine")}
        </button>
      </div>
      <DiffView path={path} theirs={theirs.text} />
    </section>
  );
}
