import { useEffect } from "react";
import { dayTime } from "../../../logic/format/numbers";
import { commitOf, type Difference, type Side, sideOf, sideOfCommit } from "../../../logic/project/versions";
import { choose, followVersions, takeVersion, useVersions } from "../../../store/project/versions";
import { t } from "../../../text";
import { later } from "../../../ui/later";
import { Trouble } from "../../../ui/Trouble";
import { VersionsGit } from "./VersionsGit";
import { VersionsHistory } from "./VersionsHistory";
import "./versions.css";
import { afterWords } from "./loading";

const TextsDiff = later(() => afterWords(() => import("./TextsDiff")));

/** Versions of the program and commits: a list, and two of them beside each other, file by file. */
export function VersionsPage() {
  useEffect(followVersions, []);
  const { all, commits, git, before, after, found, chosen, trouble } = useVersions();
  const shown = found?.find(({ path }) => path === chosen);
  const any = all.length > 0 || commits.length > 0;
  return (
    <div className="pane flexcol versions" data-pane="versions">
      <div className="sub tall">
        <Choice label={t("versions.before")} value={before} onChoose={(side) => choose({ before: side })} />
        <Choice label={t("versions.after")} value={after} onChoose={(side) => choose({ after: side })} />
        <span className="grow" />
        {before !== "now" && (
          <Take side={before} file={shown?.before == null ? null : shown.path} ready={found !== null} />
        )}
      </div>
      {git && <VersionsGit status={git} />}
      <Trouble text={trouble} />
      {!any && <p className="lonely faint">{t("versions.none")}</p>}
      {any && (
        <div className="beside">
          <div className="side">
            <VersionsHistory />
            <Files found={found ?? []} chosen={chosen} />
          </div>
          {found?.length === 0 && <p className="lonely faint">{t("versions.same")}</p>}
          {shown && <TextsDiff key={shown.path} before={shown.before ?? ""} after={shown.after ?? ""} />}
        </div>
      )}
    </div>
  );
}

function Files({ found, chosen }: { found: readonly Difference[]; chosen: string | null }) {
  if (found.length === 0) return null;
  return (
    <>
      <h3>{t("versions.files")}</h3>
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
    </>
  );
}

const kindOf = ({ before, after }: Difference) =>
  before === null ? t("versions.new") : after === null ? t("versions.gone") : t("versions.changed");

interface TakeProps {
  side: Exclude<Side, "now">;
  /** The file that is shown; null where this version has no such file. */
  file: string | null;
  ready: boolean;
}

function Take({ side, file, ready }: TakeProps) {
  const whole =
    typeof side === "number"
      ? t("versions.take", { version: side })
      : t("versions.takecommit", { commit: short(side) });
  return (
    <>
      {file !== null && (
        <button
          type="button"
          className="btn sm quiet"
          title={t("versions.takefile.hint", { path: file })}
          onClick={() => void takeVersion(side, file)}
        >
          {t("versions.takefile")}
        </button>
      )}
      <button
        type="button"
        className="btn sm"
        title={t("versions.take.hint")}
        disabled={!ready}
        onClick={() => void takeVersion(side)}
      >
        {whole}
      </button>
    </>
  );
}

const short = (side: `git:${string}`) => commitOf(side).slice(0, 7);

interface ChoiceProps {
  label: string;
  value: Side;
  onChoose: (side: Side) => void;
}

function Choice({ label, value, onChoose }: ChoiceProps) {
  const { all, commits } = useVersions();
  return (
    <label className="choice">
      <span className="faint">{label}</span>
      <select className="inp" value={value} onChange={({ target }) => onChoose(sideOf(target.value))}>
        <option value="now">{t("versions.now")}</option>
        {all.length > 0 && (
          <optgroup label={t("versions.builds")}>
            {all.map(({ version, author, at, label: name }) => (
              <option key={version} value={version}>
                {t("versions.one", { version: name ? `${version} (${name})` : version, author, time: dayTime(at) })}
              </option>
            ))}
          </optgroup>
        )}
        {commits.length > 0 && (
          <optgroup label={t("versions.commits")}>
            {commits.map(({ commit, author, at, message }) => (
              <option key={commit} value={sideOfCommit(commit)}>
                {`${commit.slice(0, 7)} ${message.split("\n", 1)[0]}, ${author}, ${dayTime(at)}`}
              </option>
            ))}
          </optgroup>
        )}
      </select>
    </label>
  );
}
