import { useState } from "react";
import { copyName } from "../../logic/instances";
import { t } from "../../logic/text";
import { importInstance, useInstances } from "../../store/instances";
import { AskName } from "../../ui/AskName";

/** Asks for a run file of this computer, and for the name of the instance that goes on with it. */
export function ImportRun({ onClose }: { onClose: () => void }) {
  const [file, setFile] = useState<File | null>(null);
  const taken = useInstances((instances) => instances.all).map(({ name }) => name);

  // The transfer shows itself below the list: the dialog need not stay for it.
  async function start(name: string): Promise<void> {
    if (!file) throw new Error(t("instances.import.missing"));
    void importInstance(name, file);
  }

  return (
    <AskName
      title={t("instances.import.title")}
      about={t("instances.import.about")}
      label={t("instances.name")}
      action={t("instances.import.do")}
      initial={copyName("import", taken)}
      onName={start}
      onClose={onClose}
    >
      <label className="field">
        <span>{t("instances.import.file")}</span>
        <input type="file" className="inp file" onChange={(event) => setFile(event.target.files?.[0] ?? null)} />
      </label>
    </AskName>
  );
}
