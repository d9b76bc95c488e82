import { useState } from "react";
import { t } from "../../logic/text";
import { deleteFile, messageOf } from "../../store/documents";
import { Dialog } from "../../ui/Dialog";
import { Icon } from "../../ui/Icon";

/** Deleting a file cannot be undone, so this one asks. */
export function DeleteFile({ path, onClose }: { path: string; onClose: () => void }) {
  const [refused, setRefused] = useState<string | null>(null);

  async function remove(): Promise<void> {
    try {
      await deleteFile(path);
      onClose();
    } catch (error) {
      setRefused(messageOf(error));
    }
  }

  return (
    <Dialog
      title={t("file.delete.title", { path })}
      about={t("file.delete.about")}
      onClose={onClose}
      onSubmit={() => void remove()}
      footer={
        <>
          <span className="hint bad grow" role="alert">
            {refused && (
              <>
                <Icon name="error" small />
                {refused}
              </>
            )}
          </span>
          <button type="button" className="btn quiet" onClick={onClose}>
            {t("cancel")}
          </button>
          <button type="submit" className="btn danger">
            {t("file.delete")}
          </button>
        </>
      }
    >
      <p className="desc">{t("file.delete.hint")}</p>
    </Dialog>
  );
}
