import { useEffect } from "react";
import { deleteFile } from "../../../store/project/documents";
import { othersOf, usePeople } from "../../../store/project/people";
import { refreshUnsaved, useUnsavedPaths } from "../../../store/project/unsaved";
import { t } from "../../../text";
import { Confirm } from "../../../ui/Confirm";

/** Deleting a file cannot be undone, so this dialog asks. */
export function DeleteFile({ path, onClose }: { path: string; onClose: () => void }) {
  const there = [...new Set(othersOf(usePeople()).flatMap(({ file, name }) => (file === path ? [name] : [])))];
  const unsaved = useUnsavedPaths().includes(path);
  useEffect(() => void refreshUnsaved().catch(() => undefined), []);
  const names = there.join(", ");
  return (
    <Confirm
      title={t("file.delete.title", { path })}
      about={t("file.delete.about")}
      hint={
        <>
          {there.length > 0 && <b>{t(unsaved ? "file.delete.here.unsaved" : "file.delete.here", { names })} </b>}
          {there.length === 0 && unsaved && <b>{t("file.delete.unsaved")} </b>}
          {t("file.delete.hint")}
        </>
      }
      verb={t("file.delete")}
      onDo={() => deleteFile(path)}
      onClose={onClose}
    />
  );
}
