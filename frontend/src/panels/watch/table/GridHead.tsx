import type { Sort, SortColumn } from "../../../logic/watch/watchsort";
import { sortBy, useWatchList } from "../../../store/watch/watchlist";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import type { Columns } from "../../../ui/useColumns";

const WATCH_COLUMNS = ["current", "change", "type", "address", "bound"] as const;
type WatchColumn = (typeof WATCH_COLUMNS)[number];

const LOOK: Record<WatchColumn, string> = { current: "num", change: "num", type: "c-type", address: "", bound: "" };

/** The column heads: a click sorts, a second click reverses the order, a third one restores the order of the list. */
export function GridHead({ grip }: Pick<Columns, "grip">) {
  const sort = useWatchList((list) => list.sort);
  return (
    <div className="gr h" role="row" aria-rowindex={1}>
      <span className="gut" role="columnheader">
        <span className="unseen">{t("force.column")}</span>
      </span>
      <span role="columnheader" aria-label={t("watch.target")} className="first" aria-sort={direction(sort, "target")}>
        <SortButton column="target" sort={sort} />
        {grip("target", t("watch.target"))}
      </span>
      {WATCH_COLUMNS.map((column) => (
        <span
          key={column}
          role="columnheader"
          aria-label={t(`watch.${column}`)}
          className={LOOK[column]}
          aria-sort={direction(sort, column)}
        >
          <SortButton column={column} sort={sort} />
          {column !== "bound" && grip(column, t(`watch.${column}`))}
        </span>
      ))}
      <span role="columnheader">
        <span className="unseen">{t("watch.remove")}</span>
      </span>
    </div>
  );
}

function direction(sort: Sort, column: SortColumn): "ascending" | "descending" | undefined {
  if (sort?.column !== column) return undefined;
  return sort.down ? "descending" : "ascending";
}

function SortButton({ column, sort }: { column: SortColumn; sort: Sort }) {
  const mine = sort?.column === column;
  return (
    <button
      type="button"
      className="sorts"
      tabIndex={-1}
      title={t(mine ? (sort.down ? "watch.sort.listed" : "watch.sort.down") : "watch.sort.up")}
      onClick={() => sortBy(column)}
    >
      {t(`watch.${column}`)}
      {mine && <Icon name={sort.down ? "chev-d" : "chev-u"} small />}
    </button>
  );
}
