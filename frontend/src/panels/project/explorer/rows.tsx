import { useEffect } from "react";
import { useShallow } from "zustand/react/shallow";
import { lineOf } from "../../../logic/debug/breakpoints";
import { allErrors } from "../../../logic/errors/catalogue";
import { percent } from "../../../logic/format/numbers";
import {
  type FileNode,
  isTable,
  type PouGroup,
  type PouNode,
  pouGroups,
  shownAt,
} from "../../../logic/project/explorer";
import { useDebug } from "../../../store/debug/debug";
import { openUserErrors } from "../../../store/errors/userErrors";
import { openRack } from "../../../store/operator/rack";
import { openFile, openPage } from "../../../store/page/navigate";
import { useBench } from "../../../store/plc/bench";
import { isAway, loadMembers, useMembers } from "../../../store/plc/members";
import { usePlc } from "../../../store/plc/plc";
import { useDocuments } from "../../../store/project/documents";
import { useUnsavedPaths } from "../../../store/project/unsaved";
import { addToTrace } from "../../../store/trace/added";
import { verifyPou } from "../../../store/verify/verify";
import { showInMemory } from "../../../store/watch/memory";
import { addToWatch } from "../../../store/watch/watchlist";
import { t } from "../../../text";
import type { IconName } from "../../../ui/Icon";
import { IconButton } from "../../../ui/IconButton";
import type { MenuItem } from "../../../ui/Menu";
import { StateWord } from "../../../ui/StateWord";
import type { TreeRow } from "../../../ui/Tree";
import type { Area, ModelInfo, PlcSymbol, Pou, Problem } from "../../../wire/types";
import { type Folding, folder, useFolding } from "./folding";
import { rowsWith } from "./found";
import { PouLabel } from "./PouLabel";
import { taskRows } from "./taskRows";

const POU_ICONS: Record<Exclude<PouGroup["kind"], "plant">, IconName> = {
  program: "program",
  function_block: "fb",
  function: "fn",
  class: "fb",
  interface: "struct",
  type: "struct",
  global: "globe",
  library: "stack",
  panel: "layout",
  file: "init",
};

const SYMBOL_ICONS: Partial<Record<PlcSymbol["kind"], IconName>> = { array: "array", struct: "struct", block: "fb" };

/** Kinds of declarations that run, and so can be verified. */
const VERIFIED: readonly PouGroup["kind"][] = ["program", "function_block", "function"];

type OpenMenu = (items: readonly MenuItem[], at: { x: number; y: number }) => void;

/** The explorer's rows, top to bottom. */
export function useExplorerRows(
  openMenu: OpenMenu,
  askDelete: (path: string) => void,
  looked: string,
): readonly TreeRow[] {
  const folding = useSearching(looked, [
    "program",
    "function_block",
    "class",
    "interface",
    "function",
    "global",
    "panel",
    "plant",
    "file",
    "tasks",
    "instances",
  ]);
  // Not the texts: who types changes nothing here.
  const { pous, tasks, files, active, cursor, problems } = useDocuments(
    useShallow(({ pous, tasks, files, active, cursor, problems }) => ({
      pous,
      tasks,
      files,
      active,
      cursor,
      problems,
    })),
  );
  const here = active === null ? undefined : shownAt(pous, active, cursor?.line ?? 1);
  const { instance, model } = useBench();
  const members = useMembers((state) => state.of);
  const unsaved = useUnsavedPaths();

  const { isOpen } = folding;
  const answers = usePlc(() => !isAway());
  const showInstances = instance !== null && answers && isOpen("instances");
  useEffect(() => {
    if (showInstances && !members.has("")) void loadMembers("");
  }, [showInstances, members]);

  const rows: TreeRow[] = [];
  for (const group of pouGroups(pous, files)) {
    rows.push(folder(folding, group.kind, t(`explorer.${group.kind}`), group.nodes.length));
    if (!isOpen(group.kind)) continue;
    for (const node of group.nodes) {
      const line = node.kind === "pou" ? (node as PouNode).line : 1;
      const menu: MenuItem[] = [
        { label: t("open"), onSelect: () => openFile(node.file, line) },
        ...(VERIFIED.some((kind) => kind === group.kind)
          ? [
              {
                label: t("verify.pou", { pou: node.name }),
                icon: "differs" as const,
                onSelect: () => verifyPou(node.name),
              },
            ]
          : []),
        { label: t("file.delete.menu", { path: node.file }), separated: true, onSelect: () => askDelete(node.file) },
      ];
      rows.push({
        key: `${group.kind}:${node.file}:${node.name}`,
        level: 1,
        icon: group.kind === "plant" ? plantIcon(node.file) : POU_ICONS[group.kind],
        label: <PouLabel node={node} />,
        name: node.name,
        meta: (
          <FileMarks
            file={node.file}
            dirty={unsaved.includes(node.file)}
            problems={problems}
            holds={(line) => isAround(node, group.kind, shownAt(pous, node.file, line))}
          />
        ),
        selected: node.file === active && isAround(node, group.kind, here),
        title: node.kind === "pou" ? `${node.file}:${line}` : node.file,
        onActivate: () => openFile(node.file, line),
        onMenu: (at) => openMenu(menu, at),
      });
    }
  }
  rows.push(...taskRows(tasks, pous, folding));
  if (instance) rows.push(rackRow());
  if (instance) {
    rows.push({ ...folder(folding, "instances", t("explorer.instances")), icon: "folder" });
    if (isOpen("instances")) rows.push(...symbolRows("", 1, members, folding, openMenu));
  }
  if (model) rows.push(...modelRows(model, folding, openMenu));
  return rowsWith(rows, looked);
}

/** While something is looked for, every folder is open; of the variables those that were unfolded are looked at. */
function useSearching(looked: string, open: readonly string[]): Folding {
  const folding = useFolding(open);
  if (looked.trim() === "") return folding;
  return { ...folding, isOpen: (key) => !/^(?:symbol|area):/.test(key) || folding.isOpen(key) };
}

/** Opens the page of all inputs and outputs. */
function rackRow(): TreeRow {
  const name = t("rack.title");
  return { key: "rack", level: 0, icon: "plc", label: name, name, onActivate: openRack };
}

const plantIcon = (file: string): IconName => (isTable(file) ? "list" : "program");

/** Whether this is the declaration of its file that contains the cursor. */
function isAround(node: PouNode | FileNode, kind: PouGroup["kind"], here: Pou | undefined): boolean {
  if (node.kind === "file") return true;
  if (kind === "global") return here === undefined;
  return here ? node.name === here.name : !node.shared;
}

interface Marked {
  file: string;
  dirty: boolean;
  problems: readonly Problem[];
  /** Whether a line of the file belongs to this row: a file may contain several declarations. */
  holds: (line: number) => boolean;
}

function FileMarks({ file, dirty, problems, holds }: Marked) {
  const errors = problems.filter((problem) => problem.file === file && problem.severity === "error").length;
  const breakpoints = useDebug(
    (debug) =>
      debug.breakpoints.filter((known) => known.kind === "line" && known.file === file && holds(lineOf(known))).length,
  );
  const own = useDocuments(({ open }) => open[file] !== undefined);
  return (
    <>
      {breakpoints > 0 && <span className="bpdot" title={t("debug.bp.count", { count: breakpoints })} />}
      {errors > 0 && <span className="bad">{t("explorer.errors", { count: errors })}</span>}
      {dirty && <span className="dirty" title={t(own ? "unsaved" : "unsaved.others")} />}
    </>
  );
}

function symbolRows(
  path: string,
  level: number,
  members: ReadonlyMap<string, readonly PlcSymbol[]>,
  folding: Folding,
  openMenu: OpenMenu,
): TreeRow[] {
  return (members.get(path) ?? []).flatMap((symbol) => {
    const key = `symbol:${symbol.path}`;
    const open = symbol.expandable ? folding.isOpen(key) : undefined;
    const add = () => addToWatch([symbol.path]);
    const toggle = () => {
      folding.toggle(key);
      void loadMembers(symbol.path);
    };
    const row: TreeRow = {
      key,
      level,
      icon: SYMBOL_ICONS[symbol.kind] ?? "var",
      label: symbol.name,
      name: symbol.path,
      meta: <SymbolMeta symbol={symbol} />,
      title: [symbol.path, symbol.type, symbol.address, symbol.section].filter(Boolean).join(" · "),
      open,
      drag: symbol.path,
      onToggle: symbol.expandable ? toggle : undefined,
      onActivate: symbol.expandable ? toggle : add,
      onMenu: (at) =>
        openMenu(
          [
            { label: t("watch.addone"), icon: "eye", onSelect: add },
            ...(symbol.expandable
              ? []
              : [
                  { label: t("watch.totrace"), icon: "trigger" as const, onSelect: () => void addToTrace(symbol.path) },
                ]),
          ],
          at,
        ),
      actions: <AddButton path={symbol.path} onAdd={add} />,
    };
    return open ? [row, ...symbolRows(symbol.path, level + 1, members, folding, openMenu)] : [row];
  });
}

/** The type, or that the program is halted in this instance. */
function SymbolMeta({ symbol }: { symbol: PlcSymbol }) {
  const halted = usePlc((plc) => plc.state?.halt != null && plc.state.halt.instance === symbol.path);
  return halted ? <StateWord tone="halted" icon="halted" word={t("state.halted")} /> : symbol.type;
}

function AddButton({ path, onAdd }: { path: string; onAdd: () => void }) {
  return (
    <span className="rowaction" onClick={(event) => event.stopPropagation()}>
      <IconButton icon="plus" label={t("watch.add.path", { path })} small onClick={onAdd} />
    </span>
  );
}

function modelRows(model: ModelInfo, folding: Folding, openMenu: OpenMenu): TreeRow[] {
  const memory: TreeRow = { ...folder(folding, "memory", t("explorer.memory"), model.areas.length), icon: "mem" };
  const plc: TreeRow = { ...folder(folding, "model", t("explorer.model")), icon: "plc", meta: model.name };
  const facts = [t("explorer.vendor", model), model.description, verifiedOf(model)].filter(Boolean);
  return [
    memory,
    ...(folding.isOpen("memory") ? model.areas.flatMap((area) => areaRows(area, folding, openMenu)) : []),
    plc,
    ...(folding.isOpen("model")
      ? [...facts.map((fact) => factRow(fact)), userErrorsRow(model), hardwareRow(model)]
      : []),
  ];
}

/** Opens the page of the errors that the project defines itself. */
function userErrorsRow(model: ModelInfo): TreeRow {
  const own = allErrors(model.catalogue).filter((error) => error.user).length;
  const name = t("usererrors.title");
  return {
    key: "usererrors",
    level: 1,
    icon: "list",
    label: name,
    name,
    meta: own > 0 ? own : undefined,
    onActivate: () => openUserErrors(),
  };
}

/** Opens the page of what is fitted. */
function hardwareRow(model: ModelInfo): TreeRow {
  const name = t("hardware.title");
  return {
    key: "hardware",
    level: 1,
    icon: "plc",
    label: name,
    name,
    meta: model.hardware ? undefined : t("hardware.unknown"),
    onActivate: () => openPage("hardware"),
  };
}

/** How many of the model's facts were checked against its manuals. */
function verifiedOf({ error_count: errors, fact_count: count, verified_facts: verified }: ModelInfo): string {
  if (count === 0) return t("explorer.errorcount", { count: errors });
  return t("explorer.verified", { count, verified, share: percent((100 * verified) / count) });
}

/** An area of the memory; unfolded it says who may access it, and how. */
function areaRows(area: Area, folding: Folding, openMenu: OpenMenu): TreeRow[] {
  const add = () => addToWatch([area.first]);
  const key = `area:${area.first}`;
  const open = folding.isOpen(key);
  const row: TreeRow = {
    key,
    level: 1,
    open,
    onToggle: () => folding.toggle(key),
    icon: "mem",
    label: (
      <>
        {area.name} <span className="faint">{area.description}</span>
      </>
    ),
    name: `${area.name} ${area.description}`,
    meta: <span className="whole mono">{`${area.first}–${area.last}`}</span>,
    title: t("area.access", { program: area.program, tool: area.tool, engine: area.engine, words: area.words }),
    drag: area.first,
    onActivate: () => void showInMemory(area.first),
    onMenu: (at) =>
      openMenu(
        [
          { label: t("memory.show"), icon: "mem", onSelect: () => void showInMemory(area.first) },
          { label: t("watch.add.path", { path: area.first }), icon: "eye", onSelect: add },
        ],
        at,
      ),
  };
  if (!open) return [row];
  const who = (["program", "tool", "engine"] as const).map((side) =>
    t("explorer.access", { who: t(`explorer.access.${side}`), access: t(`explorer.access.${area[side]}`) }),
  );
  const facts = [t("explorer.words", area), ...who, t(area.retain ? "explorer.retain" : "explorer.noretain")];
  return [row, ...facts.map((fact) => ({ ...factRow(fact), key: `${key}:${fact}`, level: 2 }))];
}

function factRow(fact: string): TreeRow {
  return { key: `fact:${fact}`, level: 1, label: <span className="muted">{fact}</span>, name: fact, title: fact };
}
