import { type FormEvent, useState } from "react";
import { messageOf } from "../../../logic/format/messageOf";
import { saveAll, useUnsavedPaths } from "../../../store/project/unsaved";
import { beginGit, commitNow } from "../../../store/project/versions";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import type { GitStatus } from "../../../wire/types";

/** The folder of the project under git: how to begin, or what a commit would keep. */
export function VersionsGit({ status }: { status: GitStatus }) {
  if (status.missing)
    return (
      <p className="gitbar faint" role="note">
        {t("git.missing")}
      </p>
    );
  if (!status.folder)
    return (
      <div className="gitbar">
        <span className="faint grow">{t("git.none")}</span>
        <button type="button" className="btn sm" onClick={() => void beginGit()}>
          {t("git.begin")}
        </button>
      </div>
    );
  return <Commit status={status} />;
}

function Commit({ status }: { status: GitStatus }) {
  const { branch, folder, changes, elsewhere } = status;
  const [message, setMessage] = useState("");
  const [refused, setRefused] = useState<string | null>(null);
  const [busy, setBusy] = useState(false);
  const others = elsewhere.length > 0;
  const unsaved = useUnsavedPaths();

  async function commit(event: FormEvent): Promise<void> {
    event.preventDefault();
    if (busy || message.trim() === "") return;
    setBusy(true);
    setRefused(null);
    try {
      await commitNow(message.trim());
      setMessage("");
    } catch (error) {
      setRefused(messageOf(error));
    }
    setBusy(false);
  }

  async function saveFirst(): Promise<void> {
    try {
      const path = await saveAll();
      setRefused(path === null ? null : t("git.notsaved", { path }));
    } catch (error) {
      setRefused(messageOf(error));
    }
  }

  return (
    <>
      <form className="gitbar" onSubmit={(event) => void commit(event)}>
        <span className="mono cut" title={t("git.folder", { folder })}>
          {branch || t("git.detached")}
        </span>
        <span className="faint count" title={changes.map(({ path }) => path).join("\n")}>
          {changes.length > 0 && t("git.changes", { count: changes.length })}
          {changes.length === 0 && unsaved.length === 0 && t("git.clean")}
        </span>
        {unsaved.length > 0 && (
          <>
            <span className="st warning count" title={unsaved.join("\n")}>
              <Icon name="warning" small />
              {t("git.edited", { count: unsaved.length, path: unsaved[0] })}
            </span>
            <button type="button" className="btn sm" onClick={() => void saveFirst()}>
              {t("save")}
            </button>
          </>
        )}
        <input
          className="inp grow"
          aria-label={t("git.message")}
          placeholder={t("git.message")}
          value={message}
          onChange={({ target }) => setMessage(target.value)}
        />
        <button type="submit" className="btn sm" disabled={busy || message.trim() === ""} title={t("git.commit.hint")}>
          {others ? t("git.commit.anyway") : t("git.commit")}
        </button>
      </form>
      {others && (
        <p className="trouble st warn" role="status">
          <Icon name="warning" small />
          <span>{t("git.elsewhere", { paths: elsewhere.join(", ") })}</span>
        </p>
      )}
      {refused && (
        <p className="trouble st fatal" role="alert">
          <Icon name="error" small />
          <span>{refused}</span>
        </p>
      )}
    </>
  );
}
