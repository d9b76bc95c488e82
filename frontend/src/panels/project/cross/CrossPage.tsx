/** Who reads and who writes a variable, line by line; or which variables nobody reads. */
import { useEffect } from "react";
import { coveredAt, sitesIn } from "../../../logic/debug/coverage";
import { grouped } from "../../../logic/format/numbers";
import { lineIn } from "../../../logic/plc/sourceLines";
import { setCoverage, useCoverage } from "../../../store/debug/coverage";
import { useWidths } from "../../../store/page/columns";
import { openFile } from "../../../store/page/navigate";
import { showWriter } from "../../../store/past/writer";
import { useOnline } from "../../../store/plc/plc";
import { type CrossReference, followTexts, showUnused, type Unused, useCross } from "../../../store/project/cross";
import { useDocuments } from "../../../store/project/documents";
import { t } from "../../../text";
import { Icon, type IconName } from "../../../ui/Icon";
import { PageHead } from "../../../ui/PageHead";
import { Trouble } from "../../../ui/Trouble";
import { useColumns } from "../../../ui/useColumns";
import { useGrid } from "../../../ui/useGrid";
import { PastNote } from "../PastNote";
import "./cross.css";
import { LiveValue } from "./LiveValue";

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
      <PageHead title={name === null ? t("cross.unused") : name || t("cross.title")} name={Boolean(name)}>
        {name !== null && state === "there" && <span className="muted">{counted(references)}</span>}
        {path !== null && state === "there" && <LiveValue key={path} path={path} />}
        <span className="grow" />
        {name !== null && <CoverageButton />}
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
      </PageHead>
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

/** Which of the lines run is known while coverage is on, which is for everybody at the PLC. */
function CoverageButton() {
  const coverage = useCoverage((state) => state.coverage);
  const online = useOnline();
  if (!online) return null;
  const on = coverage?.on ?? false;
  const facts = coverage && on ? { since: grouped(coverage.since_scan), scans: grouped(coverage.scans) } : null;
  return (
    <button
      type="button"
      className={`btn quiet sm${on ? " on" : ""}`}
      aria-pressed={on}
      title={facts ? t("coverage.since", facts) : t("cross.coverage.hint")}
      onClick={() => void setCoverage(!on)}
    >
      {t("coverage.label")}
    </button>
  );
}

interface Row {
  /** What may have run: a line that reads, writes or calls. */
  runs: boolean;
  icon: IconName;
  word: string;
  place: { file: string; line: number; column: number };
  pou: string;
  text: string;
}

const ofReference = ({ access, pou, text, ...place }: CrossReference): Row => ({
  ...{ icon: LOOK[access], word: t(`cross.${access}`), place, pou, text, runs: access !== "declared" },
});

const ofUnused = ({ name, written, pou, ...place }: Unused): Row => ({
  ...{ icon: written ? "init" : "var", word: t(written ? "cross.unused.written" : "cross.unused.never"), place, pou },
  text: name,
  runs: false,
});

/** A file that is not open is as it was saved. */
const CLOSED = { text: "", savedText: "" };

/** Whether the line of a row ran; the built program may be different from the text. */
function Ran({ place: { file, line, column } }: Pick<Row, "place">) {
  const coverage = useCoverage((state) => state.coverage);
  const { text, savedText } = useDocuments((documents) => documents.open[file]) ?? CLOSED;
  const built = lineIn(text, savedText, line);
  const same = text === savedText || text.split("\n")[line - 1] === savedText.split("\n")[built - 1];
  const covered = same ? coveredAt(sitesIn(coverage, file), { line: built, column }) : null;
  if (!covered) return <span className="faint">{t(same ? "cross.ran.unknown" : "cross.ran.edited")}</span>;
  return (
    <span className="st" title={covered.says}>
      <span className={`covered ${covered.look}`} />
      {t(`coverage.${covered.look}`)}
    </span>
  );
}

function Rows({ what, rows }: { what: string; rows: readonly Row[] }) {
  const grid = useGrid({ count: rows.length });
  const { style, head } = useColumns(useWidths("cross"));
  const covers = useCoverage(({ coverage }) => coverage?.on ?? false) && rows.some(({ runs }) => runs);
  return (
    <div
      ref={grid.scroll}
      className={`grid scroll crossrows${covers ? " covers" : ""}`}
      role="table"
      aria-label={t("cross.title")}
      aria-rowcount={rows.length + 1}
      style={style}
    >
      <div className="gr h" role="row">
        {head("access", t("cross.access"))}
        {head("place", t("cross.place"))}
        {head("pou", t("cross.pou"))}
        {covers && head("ran", t("cross.ran"))}
        <span role="columnheader">{what}</span>
      </div>
      <div {...grid.body}>
        {grid.items.map((item) => {
          const row = rows[item.index];
          if (!row) return null;
          const { icon, word, place, pou, text, runs } = row;
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
              {covers && <span role="cell">{runs && <Ran place={place} />}</span>}
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
