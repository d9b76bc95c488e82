import { type DragEvent, useState } from "react";
import { pathsIn } from "../../../logic/format/paths";
import { moveEntry } from "../../../logic/watch/watchlist";
import type { WatchRow } from "../../../logic/watch/watchrows";
import { addToWatch } from "../../../store/watch/watchlist";
import { editList } from "../../../store/watch/watchlists";

/** The data type that a dragged row has besides its path: the row is to be moved. */
export const ROW_DRAG = "application/x-scanbench-watch";

interface Place {
  group: string;
  /** The entry before which it is inserted; null is the end of the group. */
  before: string | null;
}

function placeAt(rows: readonly WatchRow[], target: EventTarget): Place | null {
  const line = target instanceof Element ? target.closest<HTMLElement>("[data-index]") : null;
  const row = line ? rows[Number(line.dataset.index)] : undefined;
  if (row?.kind === "group") return { group: row.name, before: null };
  if (row?.kind === "value") return { group: row.group, before: row.root };
  return null;
}

/** Dropping on the table: its own rows are moved, also between groups; anything else is added. */
export function useRowDrop(rows: readonly WatchRow[]) {
  const [before, setBefore] = useState<Place | null>(null);

  function onDragOver(event: DragEvent): void {
    if (!event.dataTransfer.types.includes(ROW_DRAG)) return;
    event.preventDefault();
    event.stopPropagation(); // the panel would take it for a new entry
    event.dataTransfer.dropEffect = "move";
    const place = placeAt(rows, event.target);
    if (place?.group !== before?.group || place?.before !== before?.before) setBefore(place);
  }

  function onDrop(event: DragEvent): void {
    const place = placeAt(rows, event.target) ?? { group: "", before: null };
    const moved = event.dataTransfer.getData(ROW_DRAG);
    setBefore(null);
    if (moved !== "") {
      event.preventDefault();
      event.stopPropagation();
      editList((content) => moveEntry(content, moved, place.group, place.before));
    } else if (place.group !== "") {
      event.preventDefault();
      event.stopPropagation();
      addToWatch(pathsIn(event.dataTransfer.getData("text/plain")), place.group);
    }
  }

  return { before, onDragOver, onDrop, onDragEnd: () => setBefore(null), onDragLeave: () => setBefore(null) };
}
