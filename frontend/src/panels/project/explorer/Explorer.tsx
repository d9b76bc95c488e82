import { type DragEvent, useState } from "react";
import { askNewPanel, useOperatorPanels } from "../../../store/operator/panels";
import { useDocuments } from "../../../store/project/documents";
import { dropArchive } from "../../../store/project/newProject";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { IconButton } from "../../../ui/IconButton";
import { useMenu } from "../../../ui/Menu";
import { Tree } from "../../../ui/Tree";
import { PastNote } from "../PastNote";
import { AddFiles, AddingFiles } from "./AddFiles";
import { DeleteFile } from "./DeleteFile";
import { DialectChoice } from "./DialectChoice";
import { NewFile } from "./NewFile";
import { NewPanel } from "./NewPanel";
import { Outline } from "./Outline";
import { useExplorerRows } from "./rows";
import { useAddFiles } from "./useAddFiles";

/** The tree: files by what they declare, the variables of the running program, memory, model. */
export function Explorer() {
  const { open, menu } = useMenu();
  const [creating, setCreating] = useState(false);
  const [deleting, setDeleting] = useState<string | null>(null);
  const project = useDocuments((documents) => documents.project);
  const [looked, setLooked] = useState<string | null>(null);
  const rows = useExplorerRows(open, setDeleting, looked ?? "");
  const adding = useAddFiles();
  const newPanel = useOperatorPanels(({ asking }) => asking);

  function onDrag(event: DragEvent): void {
    if (event.dataTransfer.types.includes("Files")) event.preventDefault();
  }

  function onDrop(event: DragEvent): void {
    const { files: dropped, folders } = droppedOn(event.dataTransfer);
    if (dropped.length + folders.length === 0) return;
    event.preventDefault();
    const [archive] = dropped.filter(({ name }) => /\.(zip|xml)$/i.test(name));
    if (archive) dropArchive(archive);
    const files = dropped.filter(({ name }) => !/\.(zip|xml)$/i.test(name));
    if (project !== null && files.length + folders.length > 0) void adding.add(files, folders);
  }

  return (
    <nav
      className="pane left"
      aria-label={t("explorer.label")}
      data-pane="explorer"
      onDragOver={onDrag}
      onDrop={onDrop}
    >
      <div className="phead">
        <h2 className="grow">{t("explorer.label")}</h2>
        <IconButton
          icon="search"
          label={t("explorer.search")}
          small
          className={looked === null ? "" : "is-on"}
          onClick={() => setLooked(looked === null ? "" : null)}
        />
        <AddFiles adding={adding} />
        <IconButton
          icon="layout"
          label={t("operator.new")}
          small
          disabled={project === null}
          onClick={() => askNewPanel(true)}
        />
        <IconButton
          icon="plus"
          label={t("file.new")}
          small
          disabled={project === null}
          onClick={() => setCreating(true)}
        />
      </div>
      <AddingFiles adding={adding} />
      <PastNote of="files" />
      {project !== null && <DialectChoice project={project} />}
      {looked !== null && <Look text={looked} onText={setLooked} />}
      {rows.length === 0 && looked && <p className="lonely faint">{t("explorer.search.none", { text: looked })}</p>}
      <Tree label={t("explorer.label")} rows={rows} />
      <Outline />
      {menu}
      {creating && <NewFile onClose={() => setCreating(false)} />}
      {newPanel && <NewPanel onClose={() => askNewPanel(false)} />}
      {deleting !== null && <DeleteFile path={deleting} onClose={() => setDeleting(null)} />}
    </nav>
  );
}

/** The files, and the folders, which a browser also gives as files without content. Only asked during the event. */
function droppedOn({ items, files }: DataTransfer): { files: File[]; folders: FileSystemDirectoryEntry[] } {
  const entries = [...(items ?? [])].filter(({ kind }) => kind === "file").map((item) => item.webkitGetAsEntry?.());
  const folders = entries.filter((entry): entry is FileSystemDirectoryEntry => entry?.isDirectory === true);
  return { files: [...files].filter((_, at) => entries[at]?.isDirectory !== true), folders };
}

/** What the tree is looked through for; Escape shows all of it again. */
function Look({ text, onText }: { text: string; onText: (text: string | null) => void }) {
  return (
    <div className="sub">
      <span className="inp sm filter grow">
        <Icon name="search" small />
        <input
          // biome-ignore lint/a11y/noAutofocus: it appears because somebody asked to type here
          autoFocus
          type="search"
          value={text}
          placeholder={t("explorer.search")}
          aria-label={t("explorer.search")}
          spellCheck={false}
          onChange={(event) => onText(event.target.value)}
          onKeyDown={(event) => event.key === "Escape" && onText(null)}
        />
      </span>
    </div>
  );
}
