import { deleteInstance } from "../../../store/plc/instances";
import { t } from "../../../text";
import { Confirm } from "../../../ui/Confirm";
import type { Instance } from "../../../wire/types";

/** Deleting an instance cannot be undone, so this dialog asks. */
export function DeleteInstance({ instance, onClose }: { instance: Instance; onClose: () => void }) {
  return (
    <Confirm
      title={t("instances.delete.title", instance)}
      about={t("instances.delete.about")}
      hint={t("instances.delete.hint")}
      verb={t("instances.delete.do")}
      onDo={() => deleteInstance(instance)}
      onClose={onClose}
    />
  );
}
