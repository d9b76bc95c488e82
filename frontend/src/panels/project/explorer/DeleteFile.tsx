import { deleteFile } from "../../../store/project/documents";
import { t } from "../../../text";
import { Confirm } from "../../../ui/Confirm";

/** Deleting a file cannot be undone, so this dialog asks. */
export function DeleteFile({ path, onClose }: { path: string; onClose: () => void }) {
  return (
    <Confirm
      title={t("file.delete.title", { path })}
      about={t("file.delete.about")}
      hint={t("file.delete.hint")}
      verb={t("file.delete")}
      onDo={() => deleteFile(path)}
      onClose={onClose}
    />
  );
}
