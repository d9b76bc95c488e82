import { createInstance } from "../../../store/plc/bench";
import { t } from "../../../text";
import { AskName } from "../../../ui/AskName";
import type { Project } from "../../../wire/types";

/** Asks for the name of a new virtual PLC that runs a project. */
export function NewInstance({ project, onClose }: { project: Project; onClose: () => void }) {
  return (
    <AskName
      title={t("newinstance.title", { project: project.name })}
      about={t("newinstance.about", { model: project.model })}
      label={t("newinstance.name")}
      action={t("create")}
      onName={(name) => createInstance(project, name)}
      onClose={onClose}
    />
  );
}
