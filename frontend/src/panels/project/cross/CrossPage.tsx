/** Who reads and who writes a variable, line by line; or which variables nobody reads. */
import { useEffect } from "react";
import { useWidths } from "../../../store/page/columns";
import { openFile } from "../../../store/page/navigate";
import { showWriter } from "../../../store/past/writer";
import { type CrossReference, followTexts, showUnused, type Unused, useCross } from "../../../store/project/cross";
import { t } from "../../../text";
import { Icon, type IconName } from "../../../ui/Icon";
import { Trouble } from "../../../ui/Trouble";
import { useColumns } from "../../../ui/useColumns";
import { useGrid } from "../../../ui/useGrid";
import { PastNote } from "../PastNote";
import "./cross.css";

const LOOK: Record<CrossReference["access"], IconName> = {
  declared: "var",
  read: "eye",
  written: "init",
  named: "link",
};

export function CrossPage() {
  useEffect(followTexts, []);
  const { name, path, complete, state, trouble, references, unused } = useCross();
  return (
    <section className="pane flexcol cross" aria-label={t("cross.title")} data-pane="cross">
      <div className="sub tall crossbar">
        <h2 className={name ? "mono" : ""}>{name === null ? t("cross.unused") : name || t("cross.title")}</h2>
        {name !== null && state === "there" && <span className="muted">{counted(references)}</span>}
        <span className="grow" />
        {path !== null && (
          <button type="button" className="btn quiet sm" onClick={() => showWriter(path)}>
            {t("writer.menu")}
          </button>
        )}
        {name !== null && (
          <button type="button" className="btn quiet sm" onClick={() => void showUnused()}>
            {t("cross.unused")}
          </button>
        )}
      </div>
      <PastNote of="cross" />
      <Trouble text={trouble} />
      {state === "there" && !complete && (
        <p className="trouble st warning" role="status">
          <Icon name="warning" small />
          <span>{t(name === null ? "cross.unused.errors" : "cross.errors")}</span>
        </p>
      )}
      {state === "asking" && trouble === null && <p className="lonely faint">{t("cross.asking")}</p>}
      {state === "nothing" && (
        <p className="lonely faint">{name ? t("cross.nothing", { path: name }) : t("cross.nothing.here")}</p>
      )}
      {state === "there" && name === null && complete && unused.length === 0 && (
        <p className="lonely faint">{t("cross.unused.none")}</p>
      )}
      {state === "there" && (name === null ? unused.length > 0 : references.length > 0) && (
        <Rows
          what={t(name === null ? "cross.variable" : "cross.text")}
          rows={name === null ? unused.map(ofUnused) : references.map(ofReference)}
        />
      )}
    </section>
  );
}

function counted(references: readonly CrossReference[]): string {
  const of = (access: CrossReference["access"]) => references.filter((each) => each.access === access).length;
  if (of("named") > 0) return t("cross.count.named", { count: of("named") });
  return t("cross.count", { read: of("read"), written: of("written") });
}

interface Row {
  icon: IconName;
  word: string;
  place: { file: string; line: number; column: number };
  pou: string;
  text: string;
}

const ofReference = ({ access, pou, text, ...place }: CrossReference): Row => ({
  ...{ icon: LOOK[access], word: t(`cross.${access}`), place, pou, text },
});

const ofUnused = ({ name, written, pou, ...place }: Unused): Row => ({
  ...{ icon: written ? "init" : "var", word: t(written ? "cross.unused.written" : "cross.unused.never"), place, pou },
  text: name,
});

function Rows({ what, rows }: { what: string; rows: readonly Row[] }) {
  const grid = useGrid({ count: rows.length });
  const { style, head } = useColumns(useWidths("cross"));
  return (
    <div
      ref={grid.scroll}
      className="grid scroll crossrows"
      role="table"
      aria-label={t("cross.title")}
      aria-rowcount={rows.length + 1}
      style={style}
    >
      <div className="gr h" role="row">
        {head("access", t("cross.access"))}
        {head("place", t("cross.place"))}
        {head("pou", t("cross.pou"))}
        <span role="columnheader">{what}</span>
      </div>
      <div {...grid.body}>
        {grid.items.map((item) => {
          const row = rows[item.index];
          if (!row) return null;
          const { icon, word, place, pou, text } = row;
          return (
            <div
              key={item.key}
              className="gr"
              role="row"
              aria-rowindex={item.index + 2}
              style={{ transform: `translateY(${grid.topOf(item)}px)` }}
            >
              <span className="st" role="cell">
                <Icon name={icon} small />
                {word}
              </span>
              <span role="cell">
                <button
                  type="button"
                  className="link mono"
                  onClick={() => openFile(place.file, place.line, place.column)}
                >
                  {`${place.file}:${place.line}`}
                </button>
              </span>
              <span className="cut" role="cell">
                {pou}
              </span>
              <span className="mono cut" role="cell" title={text}>
                {text}
              </span>
            </div>
          );
        })}
      </div>
    </div>
  );
}
