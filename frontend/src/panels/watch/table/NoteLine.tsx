import type { CSSProperties, Ref } from "react";
import type { NoteRow } from "../../../logic/watch/watchrows";
import { force, replaceInWatch, setDraft, write } from "../../../store/watch/watchlist";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";

interface Props {
  row: NoteRow;
  style: CSSProperties;
  index: number;
  /** As high as its text needs. */
  measured: Ref<HTMLDivElement>;
}

/** The note of a row: why a value was refused and which would be accepted, or which name is unknown and what it may have meant. */
export function NoteLine({ row, style, index, measured }: Props) {
  const { note, path, root } = row;
  const refused = note.kind === "refused" || note.kind === "unknown";
  const forcing = note.verb === "force";
  const head = {
    refused: t(forcing ? "notforced" : "notwritten"),
    unsent: t("notsent"),
    unknown: t("notknown"),
    outside: t("watch.outside"),
  }[note.kind];
  const message = note.message || t("notsent.about");

  function take(value: string): void {
    setDraft(path, value);
    void (forcing ? force(path, root, value) : write(path, root, value));
  }

  return (
    <div
      ref={measured}
      className={`gr note whole${refused ? " bad" : ""}`}
      role="row"
      style={style}
      aria-rowindex={index + 2}
      data-index={index}
    >
      <span className="full" role="gridcell">
        <Icon name={refused ? "error" : note.kind === "outside" ? "warning" : "wait"} />
        <span role="alert">
          <b>{head}</b> {message}
        </span>
        {note.kind === "unknown" &&
          note.near.slice(0, 3).map((near) => (
            <button key={near} type="button" className="link mono" onClick={() => replaceInWatch(root, near)}>
              {near}
            </button>
          ))}
        {note.instead.map((value) => (
          <button key={value} type="button" className="link" onClick={() => take(value)}>
            {t(forcing ? "watch.instead.force" : "watch.instead.write", { value })}
          </button>
        ))}
      </span>
    </div>
  );
}
