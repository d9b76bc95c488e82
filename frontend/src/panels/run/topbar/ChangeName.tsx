import { chooseName, LONGEST_NAME } from "../../../store/plc/name";
import { t } from "../../../text";
import { AskName } from "../../../ui/AskName";

/** Asks for the name that others see. */
export function ChangeName({ name, onClose }: { name: string; onClose: () => void }) {
  return (
    <AskName
      title={t("name.title")}
      about={t("name.about")}
      label={t("name.label")}
      action={t("name.use")}
      initial={name}
      longest={LONGEST_NAME}
      onName={chooseName}
      onClose={onClose}
    />
  );
}
