import { useState } from "react";
import { copyName } from "../../../logic/plc/instances";
import { importInstance, useInstances } from "../../../store/plc/instances";
import { t } from "../../../text";
import { AskName } from "../../../ui/AskName";
import { Underway } from "./Underway";

/** Asks for a run file of this computer, and for the name of the new instance that continues it. It stays open until the run is imported. */
export function ImportRun({ onClose }: { onClose: () => void }) {
  const [file, setFile] = useState<File | null>(null);
  const { all, transfer } = useInstances();
  const taken = all.map(({ name }) => name);

  async function start(name: string): Promise<void> {
    if (!file) throw new Error(t("instances.import.missing"));
    await importInstance(name, file);
  }

  return (
    <AskName
      title={t("instances.import.title")}
      about={t("instances.import.about")}
      label={t("instances.name")}
      action={t("instances.import.do")}
      initial={file ? nameOf(file, taken) : ""}
      onName={start}
      onClose={() => {
        transfer?.cancel();
        onClose();
      }}
    >
      <label className="field">
        <span>{t("instances.import.file")}</span>
        <input type="file" className="inp file" onChange={(event) => setFile(event.target.files?.[0] ?? null)} />
      </label>
      {transfer && <Underway transfer={transfer} />}
    </AskName>
  );
}

/** The name of the file without its extension, with a number if that name is taken. */
function nameOf(file: File, taken: readonly string[]): string {
  const name = file.name.replace(/\.[^.]*$/, "");
  return taken.includes(name) ? copyName(name, taken) : name;
}
