import { useState } from "react";
import { t } from "../../logic/text";
import { createInstance } from "../../store/bench";
import { messageOf } from "../../store/documents";
import { Dialog } from "../../ui/Dialog";
import { Field } from "../../ui/Field";
import type { Project } from "../../wire/types";

/** Asks for the name of another virtual PLC that runs a project. */
export function NewInstance({ project, onClose }: { project: Project; onClose: () => void }) {
  const [name, setName] = useState("");
  const [refused, setRefused] = useState<string | null>(null);

  async function create(): Promise<void> {
    if (name.trim() === "") {
      setRefused(t("name.missing"));
      return;
    }
    try {
      await createInstance(project, name.trim());
      onClose();
    } catch (error) {
      setRefused(messageOf(error));
    }
  }

  return (
    <Dialog
      title={t("newinstance.title", { project: project.name })}
      about={t("newinstance.about", { model: project.model })}
      onClose={onClose}
      onSubmit={() => void create()}
      footer={
        <>
          <span className="grow" />
          <button type="button" className="btn quiet" onClick={onClose}>
            {t("cancel")}
          </button>
          <button type="submit" className="btn primary">
            {t("create")}
          </button>
        </>
      }
    >
      <Field label={t("newinstance.name")} value={name} onChange={setName} refused={refused} />
    </Dialog>
  );
}
