import type { CSSProperties } from "react";
import { splitPath } from "../../../logic/format/paths";
import { memberName, type ValueRow } from "../../../logic/watch/watchrows";
import { useForbidden } from "../../../store/plc/plc";
import { useWatches } from "../../../store/plc/watches";
import { useForcedAt, useForces } from "../../../store/watch/forces";
import {
  releaseForce,
  removeFromWatch,
  select,
  toggle,
  toggleOpen,
  useWatchList,
} from "../../../store/watch/watchlist";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { IconButton } from "../../../ui/IconButton";
import type { ForceInfo, PlcSymbol } from "../../../wire/types";
import { AddressCell, BoundCell } from "./BoundCell";
import { ChangeCell } from "./ChangeCell";
import { CurrentCell } from "./CurrentCell";
import { mayWrite } from "./gridKeys";
import { usePicked } from "./usePicked";
import { ROW_DRAG } from "./useRowDrop";

interface Props {
  row: ValueRow;
  style: CSSProperties;
  index: number;
  selected: boolean;
  /** A dragged entry would be inserted before this row. */
  target: boolean;
  onMenu: (at: { x: number; y: number }) => void;
}

/** One variable or address of the watch table. */
export function ValueLine({ row, style, index, selected, target, onMenu }: Props) {
  const answered = useWatches((state) => state.symbols.get(row.path));
  const refusal = useWatches((state) => state.refusals.get(row.path));
  const picked = usePicked(row);
  const forced = useForcedAt(picked);
  const by = useForces((forces) => forces.written.get(row.path));
  const ownFormat = useWatchList((list) => list.formats.get(row.path));
  const symbol = row.symbol ?? answered ?? null;
  const { own, name } = row.level === 0 ? splitPath(row.path) : { own: "", name: memberName(row) };
  const title = [
    row.path,
    by ? t("watch.writtenby", { author: by.author, scan: by.scan }) : "",
    forced ? forcedBy(forced) : "",
  ]
    .filter(Boolean)
    .join("\n");

  return (
    <div
      id={`watch-${index}`}
      className={`gr${selected ? " on" : ""}${target ? " dropbefore" : ""}`}
      role="row"
      style={style}
      aria-rowindex={index + 2}
      aria-level={row.level + 1}
      aria-expanded={symbol?.expandable ? row.open : undefined}
      aria-selected={selected}
      data-path={row.path}
      data-index={index}
      onClick={() => select(row.path)}
      onDoubleClick={({ target }) => {
        const entry = (target as HTMLElement).closest("input, button");
        if (entry === null && symbol?.kind === "bool" && mayWrite()) void toggle(row);
      }}
      onContextMenu={(event) => {
        event.preventDefault();
        select(row.path);
        onMenu({ x: event.clientX, y: event.clientY });
      }}
    >
      <span className="gut" role="gridcell">
        {forced && <Lock path={row.path} forced={forced} />}
      </span>
      <span
        className="name"
        role="gridcell"
        title={title}
        draggable={row.level === 0}
        onDragStart={({ dataTransfer }) => {
          dataTransfer.setData("text/plain", row.path);
          dataTransfer.setData(ROW_DRAG, row.root);
          dataTransfer.effectAllowed = "copyMove";
        }}
      >
        {symbol?.expandable ? (
          <button
            type="button"
            className="twist"
            tabIndex={-1}
            aria-label={t(row.open ? "watch.fold" : "watch.unfold", { path: row.path })}
            onClick={() => void toggleOpen(row.path)}
          >
            <Icon name={row.open ? "chev-d" : "chev-r"} className="tw" />
          </button>
        ) : (
          <span className="tw" />
        )}
        <span className="path">
          <span className="own">{own}</span>
          <span className="last">{name}</span>
        </span>
      </span>
      <CurrentCell
        path={row.path}
        from={picked}
        symbol={symbol}
        refusal={refusal ?? null}
        format={(row.level > 0 && ownFormat) || row.format}
      />
      <ChangeCell row={row} symbol={symbol} forced={forced !== undefined} />
      <span className="mono muted c-type" role="gridcell" title={symbol ? typeTitle(symbol) : undefined}>
        {symbol?.range || symbol?.type || ""}
      </span>
      <AddressCell row={row} symbol={symbol} />
      <BoundCell row={row} symbol={symbol} />
      <span className="end" role="gridcell">
        {row.level === 0 && (
          <IconButton
            icon="x"
            small
            label={t("watch.remove.path", { path: row.path })}
            onClick={() => removeFromWatch(row.root)}
          />
        )}
      </span>
    </div>
  );
}

/** A named subrange is shown by its bounds; the tooltip has the name. */
const typeTitle = ({ type, range }: PlcSymbol) => (range && range !== type ? `${type}: ${range}` : type);

const forcedBy = ({ value, author }: ForceInfo) => t("force.by", { value, author });

function Lock({ path, forced }: { path: string; forced: ForceInfo }) {
  const locked = useForbidden("force");
  return (
    <button
      type="button"
      className="lock st forced"
      tabIndex={-1}
      aria-label={t("force.release.path", { path })}
      title={`${forcedBy(forced)}\n${locked ?? t("force.release")}`}
      disabled={locked !== null}
      onClick={() => void releaseForce(forced.path)}
    >
      <Icon name="forced" small />
    </button>
  );
}
