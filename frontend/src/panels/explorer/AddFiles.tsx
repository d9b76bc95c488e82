import { useRef, useState } from "react";
import { decodeText } from "../../logic/decode";
import { FILE_ENDINGS } from "../../logic/explorer";
import { t } from "../../logic/text";
import { createFile, messageOf, useDocuments } from "../../store/documents";
import { openFile } from "../../store/navigate";
import { Dialog } from "../../ui/Dialog";
import { IconButton } from "../../ui/IconButton";

/** Brings program files from this computer into the project; what could not be taken is listed with the reason. */
export function AddFiles() {
  const input = useRef<HTMLInputElement>(null);
  const [refused, setRefused] = useState<readonly string[]>([]);
  const project = useDocuments((documents) => documents.project);

  async function add(chosen: readonly File[]): Promise<void> {
    const refusals: string[] = [];
    const added: string[] = [];
    for (const file of chosen) {
      try {
        await addFile(file);
        added.push(file.name);
      } catch (error) {
        refusals.push(`${file.name}: ${messageOf(error)}`);
      }
    }
    setRefused(refusals);
    const [first] = added;
    if (first !== undefined) openFile(first, 1);
  }

  return (
    <>
      <input
        ref={input}
        type="file"
        multiple
        hidden
        accept={FILE_ENDINGS}
        aria-label={t("file.add")}
        onChange={(event) => {
          void add([...(event.target.files ?? [])]);
          event.target.value = ""; // the same file may be chosen again
        }}
      />
      <IconButton
        icon="import"
        label={t("file.add")}
        small
        disabled={project === null}
        onClick={() => input.current?.click()}
      />
      {refused.length > 0 && (
        <Dialog
          title={t("file.add.refused")}
          onClose={() => setRefused([])}
          onSubmit={() => setRefused([])}
          footer={
            <>
              <span className="grow" />
              <button type="submit" className="btn primary">
                {t("close")}
              </button>
            </>
          }
        >
          <ul className="plainlist">
            {refused.map((why) => (
              <li key={why}>{why}</li>
            ))}
          </ul>
        </Dialog>
      )}
    </>
  );
}

async function addFile(file: File): Promise<void> {
  const known = useDocuments.getState().files;
  if (known.some(({ path }) => path.toLowerCase() === file.name.toLowerCase())) throw new Error(t("file.add.exists"));
  await createFile(file.name, decodeText(new Uint8Array(await file.arrayBuffer())));
}
