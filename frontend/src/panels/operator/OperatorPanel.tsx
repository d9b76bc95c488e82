/** An operator panel: the file of a project that is drawn instead of read. */
import { type CSSProperties, type KeyboardEvent, useEffect, useRef, useState } from "react";
import { addElement, KINDS, type Kind, newId } from "../../logic/operator/panel";
import { panelName } from "../../logic/project/panelFiles";
import { canUndo, editPanel, openPanel, undoPanelEdit, useOperatorPanels } from "../../store/operator/panels";
import { loadRack } from "../../store/operator/rack";
import { panelLink } from "../../store/plc/links";
import { useDocuments } from "../../store/project/documents";
import { t } from "../../text";
import { Empty } from "../../ui/Empty";
import { Icon } from "../../ui/Icon";
import { MenuButton } from "../../ui/Menu";
import { ElementForm } from "./ElementForm";
import { CELL, PanelGrid } from "./PanelGrid";
import "./operator.css";
import { useZoom } from "./useZoom";

/** `alone`: it has the whole window, for those who operate and do not edit. */
export function OperatorPanel({ path, alone = false }: { path: string; alone?: boolean }) {
  const project = useDocuments((documents) => documents.project);
  const there = useDocuments(({ files }) => files.length === 0 || files.some((file) => file.path === path));
  const open = useOperatorPanels((panels) => panels.open[path]);
  const [editing, setEditing] = useState(false);
  const [selected, setSelected] = useState<string | null>(null);
  // biome-ignore lint/correctness/useExhaustiveDependencies: a panel of a kept layout exists before the project is known
  useEffect(() => void openPanel(path), [path, project, there]);
  useEffect(() => {
    if (editing) void loadRack(); // tells the inputs, which are switched, from the outputs
  }, [editing]);

  const panel = open?.panel ?? { elements: [] };
  const scroll = useRef<HTMLDivElement>(null);
  const zoom = useZoom(scroll, panel, alone);
  const element = panel.elements.find(({ id }) => id === selected);
  const broken = open !== undefined && (open.wrong !== null || (open.trouble !== null && open.version === 0));

  function onKeyDown(event: KeyboardEvent): void {
    const typing = event.target instanceof HTMLInputElement;
    if (!editing || typing || !(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== "z") return;
    event.preventDefault();
    undoPanelEdit(path);
  }

  function add(kind: Kind): void {
    const id = newId();
    const { clientWidth = 0 } = scroll.current ?? {};
    editPanel(path, (now) => addElement(now, { id, kind }, clientWidth / CELL));
    setEditing(true);
    setSelected(id);
  }

  return (
    <section
      className="pane flexcol operator"
      aria-label={t("operator.of", { name: panelName(path) })}
      data-pane="operator"
      data-live
      onKeyDown={onKeyDown}
    >
      {!alone && open !== undefined && !broken && (
        <div className="opbar1">
          <button
            type="button"
            className={`btn sm${editing ? " primary" : ""}`}
            aria-pressed={editing}
            onClick={() => {
              setEditing(!editing);
              setSelected(null);
            }}
          >
            {t(editing ? "operator.done" : "operator.edit")}
          </button>
          <MenuButton
            label={t("operator.add")}
            items={() => KINDS.map((kind) => ({ label: t(`operator.kind.${kind}`), onSelect: () => add(kind) }))}
          >
            <Icon name="plus" small />
            {t("operator.add")}
          </MenuButton>
          {editing && (
            <button
              type="button"
              className="btn quiet sm"
              title={`${t("operator.undo.about")} (Ctrl+Z)`}
              disabled={!canUndo(path)}
              onClick={() => undoPanelEdit(path)}
            >
              {t("operator.undo")}
            </button>
          )}
          <span className="grow" />
          <a
            className="btn quiet sm"
            href={panelLink(path)}
            target="_blank"
            rel="noreferrer"
            title={t("operator.alone.about")}
          >
            <Icon name="link" small />
            {t("operator.alone")}
          </a>
        </div>
      )}
      {open?.trouble && (
        <p className="trouble st warning" role="status">
          <Icon name="warning" small />
          <span>
            {t(`operator.${open.version === 0 ? "notloaded" : open.kept ? "notsaved" : "notkept"}`, {
              path,
              message: open.trouble,
            })}
          </span>
        </p>
      )}
      {open === undefined && !there && (
        <p className="lonely">
          <Icon name="trash" />
          {t("operator.gone", { path })}
        </p>
      )}
      {open?.wrong && (
        <p className="lonely">
          <Icon name="error" />
          {t(`operator.wrong.${open.wrong.why}`, { path, at: open.wrong.at })}
        </p>
      )}
      {open !== undefined && !broken && (
        <div className="opbody">
          <div ref={scroll} className="opscroll" style={{ "--zoom": zoom } as CSSProperties}>
            {panel.elements.length === 0 && !editing ? (
              <EmptyPanel alone={alone} onEdit={() => setEditing(true)} />
            ) : (
              <PanelGrid path={path} panel={panel} editing={editing} selected={selected} onSelect={setSelected} />
            )}
          </div>
          {editing &&
            (element ? (
              <ElementForm key={element.id} path={path} element={element} onRemoved={() => setSelected(null)} />
            ) : (
              <p className="opform muted">{t("operator.edit.about")}</p>
            ))}
        </div>
      )}
    </section>
  );
}

function EmptyPanel({ alone, onEdit }: { alone: boolean; onEdit: () => void }) {
  return (
    <Empty
      title={t("operator.empty")}
      about={t("operator.empty.about")}
      ways={[
        { icon: "plus", strong: t("operator.add"), rest: t("operator.empty.add") },
        { icon: "mouse", strong: t("operator.empty.drag"), rest: t("operator.empty.drag.about") },
      ]}
    >
      {!alone && (
        <button type="button" className="btn primary" onClick={onEdit}>
          {t("operator.edit")}
        </button>
      )}
    </Empty>
  );
}
