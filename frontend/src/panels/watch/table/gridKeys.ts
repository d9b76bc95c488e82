/** The keys of the watch table, for the selected row. */
import type { KeyboardEvent } from "react";
import { forbidden } from "../../../logic/plc/permits";
import type { WatchRow } from "../../../logic/watch/watchrows";
import { usePlc } from "../../../store/plc/plc";
import { useWatches } from "../../../store/plc/watches";
import {
  dismissRefusals,
  force,
  releaseForce,
  removeFromWatch,
  shownText,
  toggle,
  toggleGroup,
  toggleOpen,
  useWatchList,
} from "../../../store/watch/watchlist";
import { undoEdit } from "../../../store/watch/watchlists";
import { copyText } from "./rowMenu";

/** Without a connection, in the past and where a mode forbids it, no key writes. */
export const mayWrite = () => {
  const { state, link } = usePlc.getState();
  return forbidden(state, link.state === "open", "write") === null;
};

/** False when the key has no meaning here. */
export function gridKey(event: KeyboardEvent<HTMLDivElement>, row: WatchRow | undefined): boolean {
  const grid = event.currentTarget;
  if ((event.ctrlKey || event.metaKey) && event.key.toLowerCase() === "z") {
    undoEdit();
    return true;
  }
  if (event.key === "Escape") return dismissRefusals();
  if (row?.kind === "group") {
    if (!["Enter", " "].includes(event.key) && event.key !== (row.open ? "ArrowLeft" : "ArrowRight")) return false;
    toggleGroup(row.name);
    return true;
  }
  if (row?.kind !== "value") return false;
  const symbol = row.symbol ?? useWatches.getState().symbols.get(row.path);
  if ((event.ctrlKey || event.metaKey) && event.key.toLowerCase() === "c" && getSelection()?.isCollapsed !== false) {
    copyText(event.shiftKey ? shownText(row) : row.path);
    return true;
  }
  switch (event.key) {
    case "ArrowRight":
      if (!row.open && symbol?.expandable) void toggleOpen(row.path);
      return true;
    case "ArrowLeft":
      if (row.open) void toggleOpen(row.path);
      return true;
    case "Enter":
    case "F2":
      grid.querySelector<HTMLElement>(".gr.on input")?.focus();
      return true;
    case " ":
      if (symbol?.kind === "bool" && mayWrite()) void toggle(row);
      return true;
    case "F7":
      if (event.shiftKey) void releaseForce(row.path);
      else if (symbol && !symbol.expandable) {
        const typed = useWatchList.getState().drafts.get(row.path);
        void force(row.path, row.root, typed || shownText(row));
      }
      return true;
    case "Delete":
      removeFromWatch(row.root);
      return true;
    default:
      return false;
  }
}
