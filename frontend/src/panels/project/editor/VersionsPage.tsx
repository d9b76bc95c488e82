import { dayTime } from "../../../logic/format/numbers";
import type { Difference } from "../../../logic/project/versions";
import { choose, type Side, takeVersion, useVersions } from "../../../store/project/versions";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { later } from "../../../ui/later";
import "./versions.css";
import { afterWords } from "./loading";

const TextsDiff = later(() => afterWords(() => import("./TextsDiff")));

/** Two versions of the program beside each other, file by file. */
export function VersionsPage() {
  const { all, before, after, found, chosen, trouble } = useVersions();
  const shown = found?.find(({ path }) => path === chosen);
  return (
    <div className="pane flexcol versions" data-pane="versions">
      <div className="sub tall">
        <Choice label={t("versions.before")} value={before} onChoose={(side) => choose({ before: side })} />
        <Choice label={t("versions.after")} value={after} onChoose={(side) => choose({ after: side })} />
        <span className="grow" />
        {before !== "now" && (
          <button
            type="button"
            className="btn sm"
            title={t("versions.take.hint")}
            disabled={found === null}
            onClick={() => void takeVersion(before)}
          >
            {t("versions.take", { version: before })}
          </button>
        )}
      </div>
      {trouble && (
        <p className="trouble st fatal" role="alert">
          <Icon name="error" small />
          <span>{trouble}</span>
        </p>
      )}
      {all.length === 0 && <p className="lonely faint">{t("versions.none")}</p>}
      {all.length > 0 && found?.length === 0 && <p className="lonely faint">{t("versions.same")}</p>}
      {found && found.length > 0 && (
        <div className="two">
          <ul aria-label={t("versions.files")}>
            {found.map((each) => (
              <li key={each.path}>
                <button
                  type="button"
                  className={each.path === chosen ? "on" : ""}
                  aria-pressed={each.path === chosen}
                  onClick={() => choose({ chosen: each.path })}
                >
                  <span className="mono cut">{each.path}</span>
                  <span className="faint">{kindOf(each)}</span>
                </button>
              </li>
            ))}
          </ul>
          {shown && <TextsDiff key={shown.path} before={shown.before ?? ""} after={shown.after ?? ""} />}
        </div>
      )}
    </div>
  );
}

const kindOf = ({ before, after }: Difference) =>
  before === null ? t("versions.new") : after === null ? t("versions.gone") : t("versions.changed");

interface ChoiceProps {
  label: string;
  value: Side;
  onChoose: (side: Side) => void;
}

function Choice({ label, value, onChoose }: ChoiceProps) {
  const all = useVersions((versions) => versions.all);
  return (
    <label className="choice">
      <span className="faint">{label}</span>
      <select
        className="inp"
        value={value}
        onChange={({ target }) => onChoose(target.value === "now" ? "now" : Number(target.value))}
      >
        <option value="now">{t("versions.now")}</option>
        {all.map(({ version, author, at }) => (
          <option key={version} value={version}>
            {t("versions.one", { version, author, time: dayTime(at) })}
          </option>
        ))}
      </select>
    </label>
  );
}
