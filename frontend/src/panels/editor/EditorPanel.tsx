import { lazy, Suspense, useEffect, useRef, useState } from "react";
import { t } from "../../logic/text";
import { messageOf, openDocument, useDocuments } from "../../store/documents";
import { Icon } from "../../ui/Icon";
import { Conflict } from "./Conflict";
import { EditorBar } from "./EditorBar";

// Monaco is 4 MB: it comes after the page stands.
const CodeView = lazy(() => import("./CodeView"));

/** The editor of one file. */
export function EditorPanel({ path }: { path: string }) {
  const project = useDocuments((documents) => documents.project);
  const loaded = useDocuments((documents) => documents.open[path] !== undefined);
  const conflict = useDocuments((documents) => documents.open[path]?.conflict ?? null);
  const deletedBy = useDocuments((documents) => documents.open[path]?.deletedBy ?? null);
  const [refused, setRefused] = useState<string | null>(null);

  const of = useRef<number | null>(null);

  // A panel that was kept from last time is here before the project is known. One that sees another project come is about
  // to be closed: the other project does not have its file.
  useEffect(() => {
    setRefused(null);
    of.current ??= project;
    if (project === null || of.current !== project) return;
    openDocument(path).catch((error: unknown) => setRefused(messageOf(error)));
  }, [path, project]);

  return (
    <section className="pane flexcol" aria-label={t("editor.of", { path })} data-pane="editor">
      <EditorBar path={path} />
      {refused !== null && (
        <p className="lonely">
          <Icon name="error" />
          {t("editor.refused", { path, message: refused })}
        </p>
      )}
      {deletedBy !== null && (
        <p className="trouble st warning" role="status">
          <Icon name="warning" small />
          <span>
            <b>{deletedBy ? t("deleted.by", { author: deletedBy, path }) : t("deleted.meanwhile", { path })}</b>{" "}
            {t("deleted.about")}
          </span>
        </p>
      )}
      {loaded && (
        <Suspense fallback={<p className="lonely faint">{t("editor.loading")}</p>}>
          <CodeView path={path} />
        </Suspense>
      )}
      {conflict && <Conflict path={path} theirs={conflict} />}
    </section>
  );
}
