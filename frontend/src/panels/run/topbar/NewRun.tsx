import { newRun } from "../../../store/debug/run";
import { t } from "../../../text";
import { Confirm } from "../../../ui/Confirm";

/** A new run cannot be undone in the page, so this dialog asks. */
export function NewRun({ onClose }: { onClose: () => void }) {
  return (
    <Confirm
      title={t("newrun.title")}
      about={t("newrun.about")}
      hint={t("newrun.hint")}
      verb={t("newrun.do")}
      onDo={newRun}
      onClose={onClose}
    />
  );
}
