import { formatsFor } from "../../../logic/format/formats";
import { chosenFor } from "../../../logic/format/paths";
import { forbidden } from "../../../logic/plc/permits";
import { moveEntry, removeGroup } from "../../../logic/watch/watchlist";
import { actualOf, type GroupRow, type ValueRow } from "../../../logic/watch/watchrows";
import { type Access, addDataBreakpoint } from "../../../store/debug/debug";
import { showWriter } from "../../../store/past/writer";
import { usePlc } from "../../../store/plc/plc";
import { useWatches } from "../../../store/plc/watches";
import { showCrossReferencesOf } from "../../../store/project/cross";
import { addToTrace } from "../../../store/trace/added";
import { askDisturb } from "../../../store/verify/disturb";
import { useBindings } from "../../../store/watch/bindings";
import { forcedAt, heldByOther } from "../../../store/watch/forces";
import { showInMemory } from "../../../store/watch/memory";
import {
  addToWatch,
  force,
  formatOf,
  releaseForce,
  removeFromWatch,
  setFormat,
  shownText,
  toggleGroup,
  useWatchList,
  write,
} from "../../../store/watch/watchlist";
import { editList, told, undoEdit, useWatchLists } from "../../../store/watch/watchlists";
import type { TextKey } from "../../../text";
import { t } from "../../../text";
import type { MenuItem } from "../../../ui/Menu";
import type { PlcSymbol } from "../../../wire/types";
import { siteShown } from "./sites";

const BOOLS = ["TRUE", "FALSE"] as const;

/** The menu of a row of the watch table. */
export function rowMenu(row: ValueRow, onNewGroup: (path: string) => void): MenuItem[] {
  const symbol = row.symbol ?? useWatches.getState().symbols.get(row.path) ?? null;
  return [
    ...forceItems(row, symbol),
    ...formatItems(row, symbol),
    ...(symbol && !symbol.expandable
      ? [
          {
            label: t("watch.totrace"),
            icon: "trigger" as const,
            separated: true,
            onSelect: () => void addToTrace(row.path),
          },
        ]
      : []),
    ...copyItems(row, symbol),
    ...(row.level === 0 ? groupItems(row, onNewGroup) : []),
    ...actualItems(row),
    ...(symbol && !symbol.expandable
      ? [
          {
            label: t("writer.menu"),
            icon: "past" as const,
            separated: true,
            onSelect: () => showWriter(row.path),
          },
        ]
      : []),
    { label: t("cross.title"), onSelect: () => void showCrossReferencesOf(row.path) },
    ...(symbol?.address ? [{ label: t("memory.show"), onSelect: () => void showInMemory(row.path) }] : []),
    ...breakItems(row, symbol),
    { label: t("watch.remove"), hint: "Del", separated: true, onSelect: () => removeFromWatch(row.root) },
  ];
}

function forceItems(row: ValueRow, symbol: PlcSymbol | null): MenuItem[] {
  const { path, root } = row;
  if (!symbol?.writable || symbol.expandable) return [];
  const plc = usePlc.getState();
  const locked = forbidden(plc.state, plc.link.state === "open", "force");
  if (symbol.kind === "bool") return [...boolItems(row, locked), ...releaseItems(row, locked)];
  const typed = useWatchList.getState().drafts.get(path);
  const shown = typed || shownText(row);
  return [
    {
      label: t("force.to", { value: shown }),
      icon: "forced",
      hint: locked ? t(locked) : (whose(path) ?? "F7"),
      disabled: locked !== null || shown === "",
      onSelect: () => void force(path, root, shown),
    },
    ...releaseItems(row, locked),
  ];
}

/** Whose force it is that would be replaced. */
function whose(path: string): string | undefined {
  const other = heldByOther(path);
  return other && t("force.held", other);
}

/** A BOOL has two values: the menu offers both, whatever the current one is. */
function boolItems({ path, root }: ValueRow, locked: TextKey | null): MenuItem[] {
  const plc = usePlc.getState();
  const unwritable = forbidden(plc.state, plc.link.state === "open", "write");
  const shown = shownText({ path, root });
  const writes = BOOLS.map((value) => ({
    label: t("watch.write.to", { value }),
    hint: unwritable ? t(unwritable) : shown !== "" && shown !== value ? "Space" : undefined,
    disabled: unwritable !== null,
    onSelect: () => void write(path, root, value),
  }));
  const forces = BOOLS.map((value) => ({
    label: t("force.to", { value }),
    icon: "forced" as const,
    hint: locked ? t(locked) : (whose(path) ?? (shown === value ? "F7" : undefined)),
    disabled: locked !== null,
    onSelect: () => void force(path, root, value),
  }));
  return [...writes, ...forces];
}

function releaseItems({ path }: ValueRow, locked: TextKey | null): MenuItem[] {
  return [
    {
      label: t("force.release"),
      icon: "unforce",
      hint: "Shift+F7",
      disabled: locked !== null || forcedAt(path) === undefined,
      onSelect: () => void releaseForce(path),
    },
    { label: t("disturb.menu"), icon: "disturbance", onSelect: () => askDisturb({ kind: "flip", path }) },
  ];
}

function formatItems({ path, root }: ValueRow, symbol: PlcSymbol | null): MenuItem[] {
  // For a range or an array: the formats of its elements.
  const shape = symbol?.expandable ? elementShape(symbol) : symbol;
  if (!shape) return [];
  const chosen = formatOf(path, root);
  return formatsFor(shape).map((format, index) => ({
    label: t(`format.${format}`),
    checked: format === chosen,
    separated: index === 0,
    onSelect: () => setFormat(path, root, format),
  }));
}

function elementShape(symbol: PlcSymbol): Pick<PlcSymbol, "kind" | "size"> | null {
  const element = /^ARRAY\[.*\] OF (\w+)$/.exec(symbol.type)?.[1];
  const size = { BYTE: 1, WORD: 2, DWORD: 4, LWORD: 8 }[element ?? ""];
  return size ? { kind: "bits", size } : null;
}

function copyItems({ path, root }: ValueRow, symbol: PlcSymbol | null): MenuItem[] {
  const value = symbol && !symbol.expandable ? shownText({ path, root }) : "";
  const address = symbol?.address ?? "";
  const row = [path, value, symbol?.type ?? "", address].join("\t");
  return [
    { label: t("copy.path"), hint: "Ctrl+C", separated: true, onSelect: () => copyText(path) },
    { label: t("copy.address"), disabled: address === "", onSelect: () => copyText(address) },
    { label: t("copy.value"), hint: "Ctrl+Shift+C", disabled: value === "", onSelect: () => copyText(value) },
    { label: t("copy.row"), onSelect: () => copyText(row) },
  ];
}

function groupItems({ path, group }: ValueRow, onNewGroup: (path: string) => void): MenuItem[] {
  const { groups } = useWatchLists.getState().content;
  const move = (to: string) => () => editList((content) => moveEntry(content, path, to, null));
  return [
    ...(group === "" ? [] : [{ label: t("watch.group.leave"), separated: true, onSelect: move("") }]),
    ...groups
      .filter((name) => name !== group)
      .map((name, index) => ({
        label: t("watch.group.to", { name }),
        separated: index === 0 && group === "",
        onSelect: move(name),
      })),
    { label: t("watch.group.new"), separated: groups.length === 0, onSelect: () => onNewGroup(path) },
  ];
}

function breakItems({ path }: ValueRow, symbol: PlcSymbol | null): MenuItem[] {
  if (!symbol) return [];
  const on = (access: Access) => () => void addDataBreakpoint(path, access);
  return [
    { label: t("debug.break.change"), icon: "bp-data", separated: true, onSelect: on("change") },
    { label: t("debug.break.write"), onSelect: on("write") },
    { label: t("debug.break.read"), onSelect: on("read") },
  ];
}

/** The variable that an in-out refers to can be watched itself. */
function actualItems({ path, inOut }: ValueRow): MenuItem[] {
  const binding = inOut === null ? undefined : useBindings.getState().of.get(inOut);
  const site = binding && siteShown(binding, chosenFor(useWatchList.getState().sites, inOut ?? ""));
  if (inOut === null || !site?.actual) return [];
  const actual = actualOf(path, inOut, site.actual);
  return [{ label: t("watch.add.path", { path: actual }), icon: "bound", onSelect: () => addToWatch([actual]) }];
}

/** The menu of a group. */
export function groupMenu({ name, open }: GroupRow, onRename: (name: string) => void): MenuItem[] {
  return [
    { label: t(open ? "watch.fold" : "watch.unfold", { path: name }), onSelect: () => toggleGroup(name) },
    { label: t("watch.group.rename"), onSelect: () => onRename(name) },
    {
      label: t("watch.group.remove"),
      separated: true,
      onSelect: () => {
        editList((content) => removeGroup(content, name));
        told(t("watch.removed", { name }), undoEdit);
      },
    },
  ];
}

export function copyText(text: string): void {
  void navigator.clipboard?.writeText(text);
}
