import { useState } from "react";
import { t } from "../../logic/text";
import { messageOf } from "../../store/documents";
import { deleteInstance } from "../../store/instances";
import { Dialog } from "../../ui/Dialog";
import { Icon } from "../../ui/Icon";
import type { Instance } from "../../wire/types";

/** Deleting an instance cannot be undone, so this one asks. */
export function DeleteInstance({ instance, onClose }: { instance: Instance; onClose: () => void }) {
  const [refused, setRefused] = useState<string | null>(null);

  async function remove(): Promise<void> {
    try {
      await deleteInstance(instance);
      onClose();
    } catch (error) {
      setRefused(messageOf(error));
    }
  }

  return (
    <Dialog
      title={t("instances.delete.title", instance)}
      about={t("instances.delete.about")}
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
            {t("instances.delete.do")}
          </button>
        </>
      }
    >
      <p className="desc">{t("instances.delete.hint")}</p>
    </Dialog>
  );
}
