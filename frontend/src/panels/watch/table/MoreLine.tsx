import type { CSSProperties } from "react";
import { grouped } from "../../../logic/format/numbers";
import type { MoreRow } from "../../../logic/watch/watchrows";
import { showMore } from "../../../store/watch/watchlist";
import { t } from "../../../text";

/** The end of a page of a large array. */
export function MoreLine({ row, style, index }: { row: MoreRow; style: CSSProperties; index: number }) {
  return (
    <div className="gr note" role="row" style={style} aria-rowindex={index + 2}>
      <span className="full" role="gridcell">
        <span>{t("watch.shown", { shown: grouped(row.shown), total: grouped(row.total) })}</span>
        <button type="button" className="link" tabIndex={-1} onClick={() => showMore(row.path)}>
          {t("watch.more")}
        </button>
      </span>
    </div>
  );
}
