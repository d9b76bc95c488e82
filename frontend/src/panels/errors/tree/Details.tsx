import { detailsInWords } from "../../../logic/errors/catalogue";
import { codeText } from "../../../logic/errors/codeText";
import { entriesIn, isEdited, needsDetails, troubles, wireDetails } from "../../../logic/errors/details";
import { isPlain } from "../../../logic/errors/shapes";
import { legendOf } from "../../../logic/errors/sources";
import { grouped, wallTime } from "../../../logic/format/numbers";
import { isOf, keyOf, labelOf } from "../../../logic/plc/errorInstances";
import { useFitted } from "../../../store/errors/hardware";
import { entriesOf, raiseAnyway, setDetail, useSimulator } from "../../../store/errors/simulator";
import { showSweeps } from "../../../store/errors/sweeps";
import { openPage } from "../../../store/page/navigate";
import { useForbidden, usePlc } from "../../../store/plc/plc";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { ReactionWord } from "../../../ui/ReactionWord";
import type { ErrorHistoryRow, ErrorInfo, GenerateOne, ReactionState } from "../../../wire/types";
import { acknowledgedBy } from "../acknowledgedBy";
import { Control } from "./controls";
import { Facts } from "./Facts";
import { Preview } from "./Preview";
import { ReactionView } from "./ReactionView";
import { RequiredLines } from "./RequiredLines";
import { ShapeFields } from "./ShapeFields";
import { Ticked, TickedPreview, useOthersTicked } from "./Ticked";

/** The selected error, or the instance of it that `of` names: what it means, which flags and words show it, what can be chosen before it is raised, and how the program reacted. */
export function Details({ error, of }: { error: ErrorInfo; of: string }) {
  const plain = useSimulator((state) => isPlain(state.shape));
  const details = useSimulator((state) => state.details);
  const row = usePlc((plc) => plc.instances.get(of) ?? plc.errors.get(error.id));
  const entries = entriesOf({ details }, error, row);
  const raised = row?.status === "generated" ? row : null;
  const edited = raised ? isEdited(error, entries, entriesIn(error, raised.details)) : details[error.id] !== undefined;
  // A fault that comes and goes is treated as present all the time, so that the layout does not jump.
  const armed = usePlc((plc) => plc.armed.some((fault) => fault.errors.some((key) => isOf(key, of))));
  const present = raised !== null || armed;
  const refused = troubles(error, entries);
  const wanted = { id: error.id, details: wireDetails(error, entries) };
  const fitted = useFitted(error, wanted);
  const ticked = useOthersTicked(wanted);
  return (
    <section className="edetail" aria-label={t("errors.details")}>
      <Heading error={error} />
      <Called error={error} wanted={wanted} />
      {error.description && <p className="muted">{error.description}</p>}
      {raised && <Raised error={error} row={raised} />}
      {row?.status === "cleared" && row.recovered_way && <Gone row={row} way={row.recovered_way} />}
      {row?.acknowledged && <p className="muted">{acknowledgedBy(row.acknowledged)}</p>}
      {!fitted && <Absent error={error} wanted={wanted} />}
      <div className="row wrap apart">
        <span className="kv">
          <span>
            {t("errors.code")}
            <b>{codeText(raised?.code ?? error.code)}</b>
          </span>
          <span>
            {t("errors.flag")}
            <b>{error.flag}</b>
          </span>
        </span>
        <div className="row wrap">
          {error.details.map((detail) => (
            <Control
              key={detail.name}
              detail={detail}
              entry={entries[detail.name] ?? { text: "", format: "decimal" }}
              trouble={refused.get(detail.name) ?? null}
              onEntry={(entry) => setDetail(error, detail.name, entry)}
            />
          ))}
        </div>
      </div>
      <Facts facts={error.facts} />
      {row?.reaction && <ReactionView error={error} of={keyOf(row)} state={row.reaction} />}
      {!row?.reaction && row?.swept && <Swept reaction={row.swept} />}
      <RequiredLines key={error.id} error={error.id} />
      {ticked && <Ticked name={error.name} />}
      {present && !ticked ? (
        <details className="again" open={!plain}>
          <summary>{t("shape.again")}</summary>
          <ShapeFields />
        </details>
      ) : (
        <ShapeFields />
      )}
      {ticked && <TickedPreview now={plain} />}
      {!ticked && (fitted || error.absent) && (!present || (edited && needsDetails(error))) && (
        <Preview wanted={[wanted]} valid={refused.size === 0} again={raised !== null} now={plain} anyway={!fitted} />
      )}
    </section>
  );
}

/** The error was not raised here, but in a run of a sweep. */
function Swept({ reaction }: { reaction: ReactionState }) {
  return (
    <section className="reaction" aria-label={t("reaction.label")}>
      <p className="row">
        <ReactionWord reaction={reaction} />
        <span className="grow muted">
          {t("reaction.swept")}{" "}
          <button type="button" className="link" onClick={showSweeps}>
            {t("sweep.tab.list")}
          </button>
        </span>
      </p>
    </section>
  );
}

function Heading({ error }: { error: ErrorInfo }) {
  const fatal = error.severity === "fatal";
  return (
    <div className="row">
      <b className="grow cut" title={error.name}>
        {error.name}
      </b>
      {error.user && <span className="chip plain">{t("errors.user")}</span>}
      <span className="chip plain" title={sourceOf(error)}>
        <Icon name={error.verified ? "check" : "info"} />
        {t(error.verified ? "errors.verified" : "errors.unverified")}
      </span>
      <span className={`chip ${fatal ? "fatal" : "halted"}`}>
        <Icon name={fatal ? "fatal" : "warning"} />
        {t(fatal ? "errors.fatal" : "errors.nonfatal")}
      </span>
    </div>
  );
}

/** What the project calls the unit, or the text of the number, that these details are of. */
function Called({ error, wanted }: { error: ErrorInfo; wanted: GenerateOne }) {
  const pairs = Object.entries(wanted.details ?? {}).map(([name, value]) => `${name}=${value}`);
  const label = usePlc((plc) => labelOf(plc.instances, error.id, pairs.join(", ")));
  return label && <p>{label}</p>;
}

/** Said before anybody tries: what is not fitted is refused, unless the device can report it all the same. */
function Absent({ error, wanted }: { error: ErrorInfo; wanted: GenerateOne }) {
  const forbidden = useForbidden("errors");
  return (
    <p className="absentnote">
      <Icon name="minus" small />
      <span>
        {t(error.absent ? "errors.absent.can" : "errors.absent.cannot")}{" "}
        <button type="button" className="link" onClick={() => openPage("hardware")}>
          {t("errors.absent.change")}
        </button>{" "}
        {error.absent && (
          <button
            type="button"
            className="link"
            disabled={forbidden !== null}
            title={forbidden ?? t("errors.anyway.hint")}
            onClick={() => void raiseAnyway([wanted])}
          >
            {t("errors.anyway")}
          </button>
        )}
      </span>
    </p>
  );
}

/** Who took it back, and how: what is recovered at the simulator has no cause any more. */
function Gone({ row, way }: { row: ErrorHistoryRow; way: NonNullable<ErrorHistoryRow["recovered_way"]> }) {
  const said = { by: row.recovered_by, at: wallTime(row.recovered_at), scan: grouped(row.recovered_scan ?? 0) };
  return <p className="muted">{t(`errors.way.${way}.by`, said)}</p>;
}

/** The source of an error, with what its abbreviations mean. */
function sourceOf({ source }: ErrorInfo): string | undefined {
  const meanings = legendOf([source]).map(({ key, meaning }) => `${key}: ${meaning}`);
  return source ? [t("errors.source", { source }), ...meanings].join("\n") : undefined;
}

function Raised({ error, row }: { error: ErrorInfo; row: ErrorHistoryRow }) {
  const said = { by: row.by ?? "", at: wallTime(row.generated_at), scan: grouped(row.generated_scan ?? 0) };
  return (
    <p className="muted">
      {t(row.generated_at ? "errors.raisedby" : "errors.raisedby.untimed", said)}
      {row.details && ` ${detailsInWords(error, row.details)}`}
    </p>
  );
}
