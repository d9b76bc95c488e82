import { resolveUserConflict } from "../../../store/errors/userErrors";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import type { FileText } from "../../../wire/types";

/** Somebody else saved first. Nothing is lost until the user chooses a version. */
export function Conflict({ theirs }: { theirs: FileText }) {
  const what = theirs.version === 0 ? t("usererrors.conflict.deleted") : t("usererrors.conflict", theirs);
  return (
    <div className="banner info" role="alert">
      <Icon name="info" />
      <span className="grow">
        <b>{what}</b> <span className="muted">{t("usererrors.conflict.about")}</span>
      </span>
      <button type="button" className="btn sm" onClick={() => void resolveUserConflict("theirs")}>
        {t("conflict.theirs")}
      </button>
      <button type="button" className="btn sm" onClick={() => void resolveUserConflict("mine")}>
        {t("conflict.mine")}
      </button>
    </div>
  );
}
