import { deleteInstance, useInstances } from "../../../store/plc/instances";
import { usePlc } from "../../../store/plc/plc";
import { t } from "../../../text";
import { Confirm } from "../../../ui/Confirm";
import type { Instance } from "../../../wire/types";

/** Deleting an instance cannot be undone, so this dialog asks. */
export function DeleteInstance({ instance, onClose }: { instance: Instance; onClose: () => void }) {
  const you = usePlc((plc) => plc.you?.name);
  const now = useInstances(({ all }) => all.find(({ id }) => id === instance.id)) ?? instance;
  const others = now.users.map(({ name }) => name).filter((name) => name !== you);
  return (
    <Confirm
      title={t("instances.delete.title", instance)}
      about={t("instances.delete.about")}
      hint={
        others.length === 0 ? (
          t("instances.delete.hint")
        ) : (
          <>
            <b>{t("instances.delete.here", { names: others.join(", ") })}</b> {t("instances.delete.hint")}
          </>
        )
      }
      verb={t("instances.delete.do")}
      onDo={() => deleteInstance(instance)}
      onClose={onClose}
    />
  );
}
