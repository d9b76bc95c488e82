import type { CSSProperties } from "react";
import { t } from "../../logic/text";
import type { NoteRow } from "../../logic/watchrows";
import { replaceInWatch } from "../../store/watchlist";
import { Icon } from "../../ui/Icon";

/** What a row has to say: why nothing was written, what is not known and what it may have meant. */
export function NoteLine({ row, style, index }: { row: NoteRow; style: CSSProperties; index: number }) {
  const { note } = row;
  const refused = note.kind !== "unsent";
  const head = { refused: t("notwritten"), unsent: t("notsent"), unknown: t("notknown") }[note.kind];
  const message = note.message || t("notsent.about");
  return (
    <div className={`gr note${refused ? " bad" : ""}`} role="row" style={style} aria-rowindex={index + 2}>
      <span className="full" role="gridcell">
        <Icon name={refused ? "error" : "wait"} />
        <span className="cut" role="alert" title={message}>
          <b>{head}</b> {message}
        </span>
        {note.near.slice(0, 3).map((near) => (
          <button key={near} type="button" className="link mono" onClick={() => replaceInWatch(row.root, near)}>
            {near}
          </button>
        ))}
      </span>
    </div>
  );
}
