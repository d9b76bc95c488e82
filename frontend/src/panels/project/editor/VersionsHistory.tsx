import { useState } from "react";
import { dayTime } from "../../../logic/format/numbers";
import { history } from "../../../logic/project/versions";
import { choose, describeVersion, useVersions } from "../../../store/project/versions";
import { t } from "../../../text";
import { Field } from "../../../ui/Field";
import { FormDialog } from "../../../ui/FormDialog";
import { Icon } from "../../../ui/Icon";
import { IconButton } from "../../../ui/IconButton";
import type { GitCommit, ProjectVersion } from "../../../wire/types";

/** Versions and commits, the last one first; the chosen one is compared with the texts as they are now. */
export function VersionsHistory() {
  const { all, commits, before } = useVersions();
  const [described, setDescribed] = useState<ProjectVersion | null>(null);
  return (
    <>
      <h3>{commits.length > 0 ? t("versions.history.git") : t("versions.history")}</h3>
      <ul className="history" aria-label={t("versions.history")}>
        {history(all, commits).map(({ side, version, commit }) => (
          <li key={side}>
            <button
              type="button"
              className={side === before ? "on" : ""}
              aria-pressed={side === before}
              title={version?.message || commit?.message || t("versions.compare")}
              onClick={() => choose({ before: side, after: "now" })}
            >
              <Icon name={version ? "record" : "branch"} small />
              {version ? <Built {...version} /> : commit && <Committed {...commit} />}
            </button>
            {version && (
              <IconButton
                icon="more"
                label={t("versions.describe", { version: version.version })}
                onClick={() => setDescribed(version)}
              />
            )}
          </li>
        ))}
      </ul>
      {described && <Describe version={described} onClose={() => setDescribed(null)} />}
    </>
  );
}

function Built({ version, label, message, author, at }: ProjectVersion) {
  return (
    <span className="entry">
      <span className="cut">
        {t("versions.number", { version })}
        {label && <b> {label}</b>}
      </span>
      {message && <span className="cut">{message}</span>}
      <span className="faint cut">{`${author}, ${dayTime(at)}`}</span>
    </span>
  );
}

function Committed({ commit, message, author, at }: GitCommit) {
  return (
    <span className="entry">
      <span className="cut">
        <span className="mono">{commit.slice(0, 7)}</span> {message}
      </span>
      <span className="faint cut">{`${author}, ${dayTime(at)}`}</span>
    </span>
  );
}

function Describe({ version, onClose }: { version: ProjectVersion; onClose: () => void }) {
  const [label, setLabel] = useState(version.label);
  const [message, setMessage] = useState(version.message);
  return (
    <FormDialog
      title={t("versions.describe", { version: version.version })}
      submit={t("save")}
      onSubmit={() => describeVersion(version.version, label.trim(), message.trim())}
      onClose={onClose}
    >
      <Field label={t("versions.label")} value={label} onChange={setLabel} placeholder={t("versions.label.example")} />
      <Field label={t("versions.message")} value={message} onChange={setMessage} />
    </FormDialog>
  );
}
