import type { CSSProperties } from "react";
import type { GroupRow } from "../../../logic/watch/watchrows";
import { toggleGroup } from "../../../store/watch/watchlist";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";

interface Props {
  row: GroupRow;
  style: CSSProperties;
  index: number;
  selected: boolean;
  onSelect: () => void;
  onMenu: (at: { x: number; y: number }) => void;
}

/** The head of a group: folds it, and accepts dropped entries. */
export function GroupLine({ row, style, index, selected, onSelect, onMenu }: Props) {
  return (
    <div
      id={`watch-${index}`}
      className={`gr grouphead${selected ? " on" : ""}`}
      role="row"
      style={style}
      aria-rowindex={index + 2}
      aria-level={1}
      aria-expanded={row.open}
      aria-selected={selected}
      data-index={index}
      onClick={onSelect}
      onDoubleClick={() => toggleGroup(row.name)}
      onContextMenu={(event) => {
        event.preventDefault();
        onSelect();
        onMenu({ x: event.clientX, y: event.clientY });
      }}
    >
      <span className="full" role="gridcell">
        <button
          type="button"
          className="twist"
          tabIndex={-1}
          aria-label={t(row.open ? "watch.fold" : "watch.unfold", { path: row.name })}
          onClick={() => toggleGroup(row.name)}
        >
          <Icon name={row.open ? "chev-d" : "chev-r"} className="tw" />
        </button>
        <b className="cut">{row.name}</b>
        <span className="faint">{row.count}</span>
      </span>
    </div>
  );
}
