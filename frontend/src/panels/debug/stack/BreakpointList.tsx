import { useState } from "react";
import { conditionsOf, isShared, lineOf, placeOf, sayBreakpoint, shapeOf } from "../../../logic/debug/breakpoints";
import { grouped } from "../../../logic/format/numbers";
import { editBreakpoint, enableBreakpoints, removeBreakpoints, useDebug, wantedOf } from "../../../store/debug/debug";
import { openFile } from "../../../store/page/navigate";
import { usePlc } from "../../../store/plc/plc";
import { useDocuments } from "../../../store/project/documents";
import { t } from "../../../text";
import { IconButton } from "../../../ui/IconButton";
import { type MenuItem, useMenu } from "../../../ui/Menu";
import { Tree, type TreeRow } from "../../../ui/Tree";
import type { BreakpointInfo } from "../../../wire/types";
import { AddBreakpoint } from "./AddBreakpoint";
import { EditBreakpoint } from "./EditBreakpoint";
import { Section } from "./Section";

/** All breakpoints of this PLC, whoever set them. */
export function BreakpointList() {
  const breakpoints = useDebug((debug) => debug.breakpoints);
  const you = usePlc((plc) => plc.you?.name);
  const { open, menu } = useMenu();
  const [edited, setEdited] = useState<BreakpointInfo | null>(null);
  const edit = (known: BreakpointInfo) => (known.kind === "line" ? editInText(known) : setEdited(known));
  const pous = useDocuments((documents) => documents.pous);
  const rows = breakpoints.map((known) => rowOf(known, placeOf(known, pous), you, edit, open));
  return (
    <Section
      id="breakpoints"
      title={t("debug.breakpoints")}
      meta={breakpoints.length || undefined}
      actions={
        <>
          <AddBreakpoint />
          {breakpoints.some(isShared) && (
            <IconButton icon="trash" label={t("debug.bp.removeall")} small onClick={() => void removeBreakpoints()} />
          )}
        </>
      }
    >
      {rows.length > 0 ? (
        <Tree label={t("debug.breakpoints")} rows={rows} />
      ) : (
        <p className="sectnote">{t("debug.bp.none")}</p>
      )}
      {menu}
      {edited && <EditBreakpoint known={edited} onClose={() => setEdited(null)} />}
    </Section>
  );
}

function editInText(known: BreakpointInfo): void {
  const line = lineOf(known);
  openFile(known.file, line);
  const does = known.log ? "log" : known.assign ? "assign" : "halt";
  editBreakpoint({ file: known.file, line, wanted: wantedOf(known), id: known.id, does });
}

function rowOf(
  known: BreakpointInfo,
  place: string,
  you: string | undefined,
  edit: (known: BreakpointInfo) => void,
  openMenu: (items: readonly MenuItem[], at: { x: number; y: number }) => void,
): TreeRow {
  const shape = shapeOf(known);
  const said = conditionsOf(known);
  const line = known.kind === "line" ? lineOf(known) : null;
  const open = () => (line === null ? edit(known) : openFile(known.file, line));
  const author = known.author === you && isShared(known) ? "" : known.author;
  return {
    key: String(known.id),
    level: 0,
    icon: shape,
    tone: shape === "bp-off" || shape === "bp-unbound" ? "" : "bpc",
    label: (
      <span className={known.enabled ? "" : "faint"}>
        {place} <span className="faint">{[said, author].filter(Boolean).join(" · ")}</span>
      </span>
    ),
    name: [place, line, said].filter(Boolean).join(" "),
    meta: (
      <>
        {known.reached > 0 && (
          <span title={t("debug.bp.reached", { count: known.reached })}>{grouped(known.reached)}×</span>
        )}
        {line !== null && <span className="mono">{line}</span>}
      </>
    ),
    title: sayBreakpoint(known),
    onActivate: open,
    onMenu: (at) => openMenu(menuOf(known, edit), at),
    actions: isShared(known) && (
      <span className="rowaction row tight" onClick={(event) => event.stopPropagation()}>
        <IconButton
          icon={known.enabled ? "bp-off" : "bp"}
          label={t(known.enabled ? "debug.bp.disable.of" : "debug.bp.enable.of", { place, line: line ?? "" })}
          small
          onClick={() => void enableBreakpoints(!known.enabled, [known.id])}
        />
        <IconButton
          icon="x"
          label={t("debug.bp.remove.of", { place, line: line ?? "" })}
          small
          onClick={() => void removeBreakpoints([known.id])}
        />
      </span>
    ),
  };
}

function menuOf(known: BreakpointInfo, edit: (known: BreakpointInfo) => void): MenuItem[] {
  const foreign = !isShared(known);
  return [
    { label: t("debug.bp.edit"), disabled: foreign, onSelect: () => edit(known) },
    {
      label: t(known.enabled ? "debug.bp.disable" : "debug.bp.enable"),
      disabled: foreign,
      onSelect: () => void enableBreakpoints(!known.enabled, [known.id]),
    },
    {
      label: t("debug.bp.remove"),
      icon: "trash",
      disabled: foreign,
      onSelect: () => void removeBreakpoints([known.id]),
    },
    {
      label: t("debug.bp.disableall"),
      separated: true,
      onSelect: () => void enableBreakpoints(false),
    },
    { label: t("debug.bp.enableall"), onSelect: () => void enableBreakpoints(true) },
  ];
}
