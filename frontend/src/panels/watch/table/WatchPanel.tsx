import { type DragEvent, useEffect, useState } from "react";
import { pathsIn } from "../../../logic/format/paths";
import { addGroup, moveEntry, renameGroup } from "../../../logic/watch/watchlist";
import { groupKey } from "../../../logic/watch/watchrows";
import { showPanel } from "../../../store/page/navigate";
import { usePlc } from "../../../store/plc/plc";
import { addToWatch, select, useWatchList } from "../../../store/watch/watchlist";
import { editList, keepAsOwn, useWatchLists } from "../../../store/watch/watchlists";
import { t } from "../../../text";
import { AskName } from "../../../ui/AskName";
import { Icon } from "../../../ui/Icon";
import { IconButton } from "../../../ui/IconButton";
import { AddBox } from "./AddBox";
import { CsvMenu } from "./CsvMenu";
import { EmptyWatch } from "./EmptyWatch";
import { FilterBar } from "./FilterBar";
import { ListPicker } from "./ListPicker";
import { useRows } from "./useRows";
import { WatchGrid } from "./WatchGrid";
import "./watch.css";

/** A group that gets a name: a new one, with its first entry, or an existing one. */
type Naming = { of: "new"; path: string | null } | { of: "old"; name: string };

/** The watch table: live values, and the place where values are changed and forced. */
export function WatchPanel() {
  const entries = useWatchLists((lists) => lists.content.entries);
  const groups = useWatchLists((lists) => lists.content.groups);
  const filter = useWatchList((list) => list.filter);
  const [over, setOver] = useState(false);
  const [filtering, setFiltering] = useState(false);
  const [naming, setNaming] = useState<Naming | null>(null);
  const rows = useRows();
  const shown = filtering ? rows.filter((row) => row.kind === "value" && row.level === 0).length : 0;
  useUndoOffer();

  function onDrop(event: DragEvent): void {
    event.preventDefault();
    setOver(false);
    const paths = pathsIn(event.dataTransfer.getData("text/plain"));
    if (paths.length > 0) addToWatch(paths);
  }

  return (
    <div
      className={`pane flexcol${over ? " dropping" : ""}`}
      data-pane="watch"
      data-live
      onDragOver={(event) => {
        if (!event.dataTransfer.types.includes("text/plain")) return;
        event.preventDefault();
        setOver(true);
      }}
      onDragLeave={() => setOver(false)}
      onDrop={onDrop}
    >
      <div className="sub">
        <ListPicker />
        <AddBox />
        <span className="grow" />
        <ForceCount />
        <IconButton
          icon="filter"
          small
          label={t("watch.filter")}
          className={filter.text !== "" || filter.only !== "all" ? "is-on" : ""}
          onClick={() => setFiltering(!filtering)}
        />
        <CsvMenu onNewGroup={() => setNaming({ of: "new", path: null })} />
      </div>
      {filtering && <FilterBar shown={shown} total={entries.length} onClose={() => setFiltering(false)} />}
      <Notices />
      {entries.length === 0 && groups.length === 0 ? (
        <EmptyWatch />
      ) : (
        <WatchGrid
          rows={rows}
          onNewGroup={(path) => setNaming({ of: "new", path })}
          onRenameGroup={(name) => setNaming({ of: "old", name })}
        />
      )}
      {naming && <NameGroup naming={naming} onClose={() => setNaming(null)} />}
    </div>
  );
}

function NameGroup({ naming, onClose }: { naming: Naming; onClose: () => void }) {
  async function onName(name: string): Promise<void> {
    if (naming.of === "old") editList((content) => renameGroup(content, naming.name, name));
    else
      editList((content) => {
        const grouped = addGroup(content, name);
        return naming.path === null ? grouped : moveEntry(grouped, naming.path, name, null);
      });
    select(groupKey(name));
  }
  return (
    <AskName
      title={t(naming.of === "old" ? "watch.group.rename" : "watch.group.new")}
      label={t("watch.group.name")}
      action={t(naming.of === "old" ? "watch.list.rename.do" : "watch.group.make")}
      initial={naming.of === "old" ? naming.name : ""}
      onName={onName}
      onClose={onClose}
    />
  );
}

/** A message about the list: not saved, deleted by somebody, or a change that can be undone. */
function Notices() {
  const { trouble, deletedBy, done, content } = useWatchLists();
  if (trouble) {
    return (
      <div className="trouble st warning" role="alert">
        <Icon name="warning" small />
        <span>
          <b>{t("watch.list.notsaved")}</b> {trouble}
        </span>
        <button type="button" className="link" onClick={() => void keepAsOwn()}>
          {t("tryagain")}
        </button>
      </div>
    );
  }
  if (deletedBy !== null) {
    return (
      <div className="trouble" role="alert">
        <span>{t("watch.list.gone", { name: content.name, author: deletedBy })}</span>
        <button type="button" className="link" onClick={() => void keepAsOwn()}>
          {t("watch.list.keep")}
        </button>
      </div>
    );
  }
  if (!done) return null;
  return (
    <div className="trouble" role="status">
      <span>{done.text}</span>
      <button type="button" className="link" onClick={done.undo}>
        {t("undo")}
      </button>
    </div>
  );
}

const UNDO_FOR = 10_000;

/** Undo is offered for a while. */
function useUndoOffer(): void {
  const done = useWatchLists((lists) => lists.done);
  useEffect(() => {
    if (!done) return;
    const timer = setTimeout(() => useWatchLists.setState({ done: null }), UNDO_FOR);
    return () => clearTimeout(timer);
  }, [done]);
}

/** The number of forces; the panel of the forces lists them. */
function ForceCount() {
  const count = usePlc((plc) => plc.state?.forces ?? 0);
  if (count === 0) return null;
  return (
    <button type="button" className="btn quiet sm" title={t("force.show")} onClick={() => showPanel("forces")}>
      <span className="st forced">
        <Icon name="forced" small />
        {t("force.count", { count })}
      </span>
    </button>
  );
}
