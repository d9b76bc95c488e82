import { deleteFile } from "../../../store/project/documents";
import { othersOf, usePeople } from "../../../store/project/people";
import { t } from "../../../text";
import { Confirm } from "../../../ui/Confirm";

/** Deleting a file cannot be undone, so this dialog asks. */
export function DeleteFile({ path, onClose }: { path: string; onClose: () => void }) {
  const there = [...new Set(othersOf(usePeople()).flatMap(({ file, name }) => (file === path ? [name] : [])))];
  return (
    <Confirm
      title={t("file.delete.title", { path })}
      about={t("file.delete.about")}
      hint={
        <>
          {there.length > 0 && <b>{t("file.delete.here", { names: there.join(", ") })} </b>}
          {t("file.delete.hint")}
        </>
      }
      verb={t("file.delete")}
      onDo={() => deleteFile(path)}
      onClose={onClose}
    />
  );
}
