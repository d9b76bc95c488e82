import { useState } from "react";
import { messageOf } from "../../../logic/format/messageOf";
import { newFilePath, skeleton } from "../../../logic/project/explorer";
import { openFile } from "../../../store/page/navigate";
import { useBench } from "../../../store/plc/bench";
import { createFile, useDocuments } from "../../../store/project/documents";
import { t } from "../../../text";
import { Dialog } from "../../../ui/Dialog";
import { Field } from "../../../ui/Field";

/** Asks for a name and makes the file with the frame of what the name promises. */
export function NewFile({ onClose }: { onClose: () => void }) {
  const files = useDocuments((documents) => documents.files);
  const input = useBench((bench) => bench.model?.areas[0]?.first);
  const [name, setName] = useState("");
  const [refused, setRefused] = useState<string | null>(null);

  async function create(): Promise<void> {
    const path = newFilePath(name, files);
    if (path === null) {
      setRefused(t("file.badname"));
      return;
    }
    try {
      await createFile(path, skeleton(path, input));
      onClose();
      openFile(path, 1);
    } catch (error) {
      setRefused(messageOf(error));
    }
  }

  return (
    <Dialog
      title={t("file.new")}
      about={t("file.new.about")}
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
      <Field label={t("file.name")} value={name} onChange={setName} refused={refused} />
    </Dialog>
  );
}
