import { useRef } from "react";
import { FILE_ENDINGS } from "../../../logic/project/explorer";
import { useDocuments } from "../../../store/project/documents";
import { t } from "../../../text";
import { Dialog } from "../../../ui/Dialog";
import { IconButton } from "../../../ui/IconButton";
import type { Adding } from "./useAddFiles";

/** Adds files from this computer to the project; refused files are listed with the reason. */
export function AddFiles({ adding }: { adding: Adding }) {
  const input = useRef<HTMLInputElement>(null);
  const project = useDocuments((documents) => documents.project);
  const { refused, add, forget } = adding;
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
          onClose={forget}
          onSubmit={forget}
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
