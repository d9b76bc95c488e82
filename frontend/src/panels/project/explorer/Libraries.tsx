import { useEffect } from "react";
import { openFile } from "../../../store/page/navigate";
import { useDocuments } from "../../../store/project/documents";
import { addLibrary, loadLibraries, reportAddress, useLibraries } from "../../../store/project/libraries";
import { t } from "../../../text";
import { Dialog } from "../../../ui/Dialog";
import type { ProjectLibrary } from "../../../wire/types";

/** The libraries of vendors for the project's dialect: which it uses and has; their texts are added as files. And the report. */
export function Libraries({ project, onClose }: { project: number; onClose: () => void }) {
  const { libraries, trouble } = useLibraries();
  const files = useDocuments((documents) => documents.files);
  // biome-ignore lint/correctness/useExhaustiveDependencies: with other files other libraries are used and there
  useEffect(() => void loadLibraries(project), [project, files]);
  return (
    <Dialog
      title={t("libraries")}
      about={t("libraries.about")}
      trouble={trouble}
      width={640}
      onClose={onClose}
      footer={
        <>
          <a className="link grow" href={reportAddress(project)} target="_blank" rel="noreferrer">
            {t("libraries.report")}
          </a>
          <button type="button" className="btn" onClick={onClose}>
            {t("close")}
          </button>
        </>
      }
    >
      {libraries?.length === 0 && <p className="faint">{t("libraries.none")}</p>}
      <ul className="libraries" aria-label={t("libraries")}>
        {libraries?.map((library) => (
          <Row
            key={library.name}
            library={library}
            onAdd={() => void addLibrary(project, library.name)}
            onShow={() => {
              openFile(library.path, 1);
              onClose();
            }}
          />
        ))}
      </ul>
    </Dialog>
  );
}

function Row({ library, onAdd, onShow }: { library: ProjectLibrary; onAdd: () => void; onShow: () => void }) {
  const { name, about, source, added, used, declared, stubs } = library;
  return (
    <li>
      <div className="grow">
        <b>{name}</b>
        {used && <span className="st warning">{t("libraries.used")}</span>}
        <p>
          {about}{" "}
          <span className="faint">
            {t("libraries.count", { declared: `${declared}`, stubs: `${stubs}` })}{" "}
            <a className="link" href={source} target="_blank" rel="noreferrer">
              {t("libraries.source")}
            </a>
          </span>
        </p>
      </div>
      {added ? (
        <button type="button" className="btn" aria-label={t("libraries.show.of", { name })} onClick={onShow}>
          {t("libraries.show")}
        </button>
      ) : (
        <button
          type="button"
          className={used ? "btn primary" : "btn"}
          aria-label={t("libraries.add.of", { name })}
          onClick={onAdd}
        >
          {t("libraries.add")}
        </button>
      )}
    </li>
  );
}
