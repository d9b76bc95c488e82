import { useEffect } from "react";
import { chosenFor } from "../../../logic/format/paths";
import { actualOf, type ValueRow } from "../../../logic/watch/watchrows";
import { watch } from "../../../store/plc/watches";
import { useBindings } from "../../../store/watch/bindings";
import { useWatchList } from "../../../store/watch/watchlist";
import { siteShown } from "./sites";

/** The variable of a row after somebody chose a different call of its in-out; else the variable of the row itself. */
export function usePicked(row: ValueRow): string {
  const chosen = useWatchList((list) => (row.inOut === null ? undefined : chosenFor(list.sites, row.inOut)));
  const binding = useBindings((bindings) => (chosen && row.inOut !== null ? bindings.of.get(row.inOut) : undefined));
  const actual = binding && siteShown(binding, chosen)?.actual;
  const path = actual && row.inOut !== null ? actualOf(row.path, row.inOut, actual) : row.path;
  useEffect(() => (path === row.path ? undefined : watch([path])), [path, row.path]);
  return path;
}
