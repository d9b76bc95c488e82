import { useEffect, useMemo, useState } from "react";
import { useShallow } from "zustand/react/shallow";
import type { SortKey } from "../../../logic/format/values";
import type { WatchRow } from "../../../logic/watch/watchrows";
import { watchRows } from "../../../logic/watch/watchrows";
import type { SortColumn } from "../../../logic/watch/watchsort";
import { useMembers } from "../../../store/plc/members";
import { hasChangedSince, sortKey } from "../../../store/plc/values";
import { useWatches } from "../../../store/plc/watches";
import { useBindings } from "../../../store/watch/bindings";
import { forceOf, useForces } from "../../../store/watch/forces";
import { useWatchList } from "../../../store/watch/watchlist";
import { useWatchLists } from "../../../store/watch/watchlists";
import { siteShown } from "./sites";

const LOOK_AGAIN = 1000;

/** The rows of the shown list, in their order. */
export function useRows(): readonly WatchRow[] {
  const { entries, groups } = useWatchLists((lists) => lists.content);
  // Neither typed values nor the selection are read here: both change with every key.
  const { open, collapsed, shown, notes, sort, filter, since, drafts } = useWatchList(
    useShallow((list) => ({
      open: list.open,
      collapsed: list.collapsed,
      shown: list.shown,
      notes: list.notes,
      sort: list.sort,
      filter: list.filter,
      since: list.since,
      drafts: list.sort?.column === "change" ? list.drafts : null,
    })),
  );
  const members = useMembers((state) => state.of);
  const symbols = useWatches((state) => state.symbols);
  const refusals = useWatches((state) => state.refusals);
  const forces = useForces((state) => state.held);
  const turn = useTurns(sort?.column === "current" || sort?.column === "bound" || filter.only === "changed");

  // biome-ignore lint/correctness/useExhaustiveDependencies: each turn reads the values again
  return useMemo(
    () =>
      watchRows({
        entries,
        groups,
        collapsed,
        open,
        shown,
        notes,
        sort,
        filter,
        members,
        symbols,
        refusals,
        keyOf: (path, column) => keyOf(path, column, drafts),
        isForced: (path) => forceOf({ held: forces }, path) !== undefined,
        hasChanged: (path) => hasChangedSince(path, since),
      }),
    [
      entries,
      groups,
      collapsed,
      open,
      shown,
      notes,
      sort,
      filter,
      members,
      symbols,
      refusals,
      forces,
      since,
      drafts,
      turn,
    ],
  );
}

function keyOf(path: string, column: SortColumn, drafts: ReadonlyMap<string, string> | null): SortKey {
  if (column === "current") return sortKey(path);
  if (column === "change") return drafts?.get(path) ?? null;
  const binding = useBindings.getState().of.get(path);
  return (binding && siteShown(binding, undefined)?.actual) ?? null;
}

/** Values change by themselves, the order of rows at most once a second, and not while somebody types in a row. */
function useTurns(on: boolean): number {
  const [turn, setTurn] = useState(0);
  useEffect(() => {
    if (!on) return;
    const timer = setInterval(() => {
      const typing = document.activeElement?.matches(".wt input");
      if (!typing) setTurn((before) => before + 1);
    }, LOOK_AGAIN);
    return () => clearInterval(timer);
  }, [on]);
  return turn;
}
