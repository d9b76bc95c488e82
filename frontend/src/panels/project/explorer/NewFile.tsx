import { useState } from "react";
import { newFilePath, skeleton } from "../../../logic/project/explorer";
import { openFile } from "../../../store/page/navigate";
import { useBench } from "../../../store/plc/bench";
import { createFile, useDocuments } from "../../../store/project/documents";
import { t } from "../../../text";
import { Field } from "../../../ui/Field";
import { FormDialog } from "../../../ui/FormDialog";

/** Asks for a name and creates the file with the text that fits the name. */
export function NewFile({ onClose }: { onClose: () => void }) {
  const files = useDocuments((documents) => documents.files);
  const input = useBench((bench) => bench.model?.areas[0]?.first);
  const [name, setName] = useState("");

  async function create(): Promise<void> {
    const path = newFilePath(name, files);
    if (path === null) throw new Error(t("file.badname"));
    await createFile(path, skeleton(path, input));
    openFile(path, 1);
  }

  return (
    <FormDialog
      title={t("file.new")}
      about={t("file.new.about")}
      submit={t("create")}
      onSubmit={create}
      onClose={onClose}
    >
      {({ refused }) => <Field label={t("file.name")} value={name} onChange={setName} refused={refused} />}
    </FormDialog>
  );
}
