import { useRef } from "react";
import { FILE_ENDINGS } from "../../../logic/project/explorer";
import { useDocuments } from "../../../store/project/documents";
import { t } from "../../../text";
import { Dialog } from "../../../ui/Dialog";
import { FileList, FileLists } from "../../../ui/FileLists";
import { IconButton } from "../../../ui/IconButton";
import type { Adding, Report } from "./useAddFiles";

/** Adds files from this computer to the project; files that are left out are listed with the reason. */
export function AddFiles({ adding }: { adding: Adding }) {
  const input = useRef<HTMLInputElement>(null);
  const project = useDocuments((documents) => documents.project);
  const { report, add, forget } = adding;
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
      {report && <Told report={report} onClose={forget} />}
    </>
  );
}

/** What was added, and what was left out and why. */
function Told({ report: { added, left, ended }, onClose }: { report: Report; onClose: () => void }) {
  const title =
    added.length === 0 ? t("file.add.refused") : t("file.add.done", { added: added.length, left: left.length });
  return (
    <Dialog
      title={title}
      width={560}
      about={ended ? t("file.add.ended") : undefined}
      onClose={onClose}
      onSubmit={onClose}
      footer={
        <>
          <span className="grow" />
          <button type="submit" className="btn primary">
            {t("close")}
          </button>
        </>
      }
    >
      <FileLists>
        <FileList title={t("file.left")} files={left} />
        <FileList title={t("file.added")} files={added.map((path) => ({ path }))} />
      </FileLists>
    </Dialog>
  );
}

/** How far it is, while files are being added. */
export function AddingFiles({ adding: { progress, end } }: { adding: Adding }) {
  if (!progress) return null;
  return (
    <p className="sub" role="status">
      <progress value={progress.done} max={progress.of} aria-label={t("file.adding", progress)} />
      <span className="cut grow">{t("file.adding", progress)}</span>
      <button type="button" className="btn quiet sm" onClick={end}>
        {t("cancel")}
      </button>
    </p>
  );
}
