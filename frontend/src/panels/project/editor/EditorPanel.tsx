import { useEffect, useRef, useState } from "react";
import { messageOf } from "../../../logic/format/messageOf";
import { useViewOf } from "../../../store/graphic/views";
import { isDirty, isKept, openDocument, useDocuments } from "../../../store/project/documents";
import { useShownProgram, useShowsRan } from "../../../store/project/shownProgram";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { later } from "../../../ui/later";
import { Breadcrumbs } from "./Breadcrumbs";
import { Conflict } from "./Conflict";
import { EditorBar } from "./EditorBar";
import { afterWords } from "./loading";

// Monaco is 4 MB: it is loaded after the page is shown.
const CodeView = later(() => afterWords(() => import("./CodeView")));
const GraphicView = later(() => afterWords(() => import("./graphic/GraphicView")));

/** Says which version is shown, and that the edited text is kept; or why there is no text. */
function PastNote({ path, version }: { path: string; version: number }) {
  const { program, refused } = useShownProgram();
  const dirty = useDocuments((documents) => isDirty(documents.open[path]));
  const says =
    refused !== null
      ? t("past.text.refused", { version, message: refused })
      : program === null
        ? t("past.text.loading", { version })
        : program.files[path] === undefined
          ? t("past.text.none", { version, path })
          : t("past.text", { version });
  return (
    <p className="trouble st past" role="status">
      <Icon name="past" small />
      <span>
        <b>{says}</b> {t(dirty ? "past.text.unsaved" : "past.text.kept")}
      </span>
    </p>
  );
}

/** The text that ran could not be fetched. The project was not built since, so the saved text is probably the one that ran. */
function UnsureNote({ version, refused }: { version: number; refused: string }) {
  return (
    <p className="trouble st warning" role="status">
      <Icon name="warning" small />
      <span>{t("past.text.unsure", { version, message: refused })}</span>
    </p>
  );
}

/** What was typed is only here: why the server does not take it, and what to do. */
function RefusedNote({ path }: { path: string }) {
  const refused = useDocuments((documents) => documents.open[path]?.refused ?? null);
  if (refused === null) return null;
  return (
    <p className="trouble st fatal" role="alert">
      <Icon name="error" small />
      <span>
        <b>{t("draft.refused", { message: refused })}</b>{" "}
        {t(isKept(path) ? "draft.refused.kept" : "draft.refused.unkept")}
      </span>
    </p>
  );
}

/**
 * The text of a file, its drawing where it has ladders or charts, or both. What is edited is Monaco's text, which stays; without its editor
 * a drawing is quicker: an editor out of sight follows each change, too.
 */
function Views({ path, past }: { path: string; past: string | null }) {
  const edited = useDocuments((documents) => documents.open[path]?.text ?? "");
  const text = past ?? edited;
  const view = useViewOf(path, text);
  return (
    <div className="edviews">
      {view !== "text" && <GraphicView path={path} text={text} readOnly={past !== null} />}
      {view !== "graphic" && (
        <div className="textview">
          <CodeView path={path} past={past} />
        </div>
      )}
    </div>
  );
}

/** The editor of one file. */
export function EditorPanel({ path }: { path: string }) {
  const project = useDocuments((documents) => documents.project);
  const loaded = useDocuments((documents) => documents.open[path] !== undefined);
  const conflict = useDocuments((documents) => documents.open[path]?.conflict ?? null);
  const deletedBy = useDocuments((documents) => documents.open[path]?.deletedBy ?? null);
  const version = useShownProgram((shown) => shown.version);
  const unsure = useShownProgram((shown) => shown.refused);
  const past = useShowsRan(path);
  const ran = useShownProgram((shown) => shown.program?.files[path]);
  const [refused, setRefused] = useState<string | null>(null);

  const of = useRef<number | null>(null);

  // A panel of a kept layout exists before the project is known. A panel whose project changes is about to be closed,
  // because the new project does not have its file.
  useEffect(() => {
    setRefused(null);
    of.current ??= project;
    if (project === null || of.current !== project) return;
    openDocument(path).catch((error: unknown) => setRefused(messageOf(error)));
  }, [path, project]);

  return (
    <section className="pane flexcol" aria-label={t("editor.of", { path })} data-pane="editor">
      <EditorBar path={path} />
      <Breadcrumbs path={path} />
      {refused !== null && !past && (
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
      <RefusedNote path={path} />
      {version !== null && past && <PastNote path={path} version={version} />}
      {version !== null && !past && unsure !== null && <UnsureNote version={version} refused={unsure} />}
      {!past ? loaded && <Views path={path} past={null} /> : ran !== undefined && <Views path={path} past={ran} />}
      {conflict && !past && <Conflict path={path} theirs={conflict} />}
    </section>
  );
}
