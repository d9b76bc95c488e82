import { inNames } from "../../../logic/errors/catalogue";
import { grouped } from "../../../logic/format/numbers";
import { linkPath } from "../../../logic/plc/links";
import { useCatalogue } from "../../../store/errors/catalogue";
import { openFile } from "../../../store/page/navigate";
import { useForbidden } from "../../../store/plc/plc";
import { travel } from "../../../store/plc/timeline";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import type { RunDivergence } from "../../../wire/types";
import { ChangesTable } from "./ChangesTable";
import { Entries } from "./Entries";

/** At most this many stretches are listed; the timeline marks all of them. */
const LISTED = 12;

interface Props {
  result: RunDivergence;
  /** Instance B. */
  b: number;
  names: Readonly<Record<"A" | "B", string>>;
}

/** The result of a comparison: the first scan in which the runs diverge, the statement, why; then the variables that differ. */
export function Divergence({ result, b, names }: Props) {
  const { scan, compared, first, last, text, changes, entries } = result;
  const { errors } = useCatalogue();
  const range = { count: grouped(compared), first: grouped(first), last: grouped(last) };
  return (
    <>
      <p className="verdict">
        {result.same === "all" ? t("compare.same.about") : inNames(errors, text)}{" "}
        <span className="faint">{t("compare.compared", range)}</span>
      </p>
      {scan !== null && <Why result={result} scan={scan} b={b} nameB={names.B} />}
      {result.marks.length > 0 && <Stretches marks={result.marks} />}
      {changes && changes.changes.length > 0 && (
        <>
          <h3>{t("compare.variables")}</h3>
          <ChangesTable
            changes={changes}
            label={t("compare.variables")}
            heads={[`A ${names.A}`, `B ${names.B}`]}
            writerBefore={scan === null ? null : scan + 1}
          />
        </>
      )}
      {result.left.length > 0 && <Left left={result.left} count={result.left_count} />}
      <Entries title={t("compare.entries")} entries={entries} names={names} onGo={(at) => void travel(at)} />
    </>
  );
}

/** What was not compared, and why. */
function Left({ left, count }: { left: RunDivergence["left"]; count: number }) {
  const title = t("compare.left", { count: grouped(count) });
  return (
    <section className="entered" aria-label={title}>
      <h3>{title}</h3>
      <ul>
        {left.map(({ path, reason }) => (
          <li key={`${path} ${reason}`}>
            {path !== "" && <span className="mono">{path}</span>}
            <span className="grow cut" title={reason}>
              {reason}
            </span>
          </li>
        ))}
        {count > left.length && <li className="faint">+{grouped(count - left.length)}</li>}
      </ul>
    </section>
  );
}

interface WhyProps {
  result: RunDivergence;
  scan: number;
  b: number;
  nameB: string;
}

function Why({ result, scan, b, nameB }: WhyProps) {
  const { place, cause } = result;
  const locked = useForbidden("travel");
  return (
    <div className="parting">
      {cause !== "" && <p className="muted">{t(`compare.cause.${cause}`)}</p>}
      {place && (
        <button type="button" className="stmt mono" onClick={() => openFile(place.file, place.line)}>
          <span className="faint">
            {place.file}:{place.line}
          </span>{" "}
          {place.text}
          <span className="faint">
            {" "}
            {place.instance} {place.task}
          </span>
        </button>
      )}
      <div className="row">
        <button
          type="button"
          className="btn sm"
          disabled={locked !== null}
          title={locked ?? undefined}
          onClick={() => void travel(scan)}
        >
          <Icon name="moved" small />
          {t("compare.goto", { scan: grouped(scan) })}
        </button>
        <a
          className="btn sm"
          href={linkPath({ instance: b, scan, panel: null })}
          target="_blank"
          rel="noreferrer"
          title={t("compare.open.hint")}
        >
          <Icon name="export" small />
          {t("compare.open", { name: nameB, scan: grouped(scan) })}
        </a>
      </div>
    </div>
  );
}

/** The stretches in which they differ: a click goes to the beginning of one. */
function Stretches({ marks }: { marks: RunDivergence["marks"] }) {
  return (
    <p className="marks">
      <span className="muted">{t("compare.marks")}</span>{" "}
      {marks.slice(0, LISTED).map(([from, to]) => (
        <button key={from} type="button" className="link mono" onClick={() => void travel(from)}>
          {from === to ? grouped(from) : t("compare.scans", { first: grouped(from), last: grouped(to) })}
        </button>
      ))}
      {marks.length > LISTED && <span className="faint">+{marks.length - LISTED}</span>}
    </p>
  );
}
