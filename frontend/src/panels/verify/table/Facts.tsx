import { useState } from "react";
import { grouped } from "../../../logic/format/numbers";
import { isEdited, ranIn, resultOf, variableOf } from "../../../logic/verify/verify";
import { bitsBeside, differingBits, shownValue, type ValueType } from "../../../logic/verify/verifyValues";
import { showWriterOf } from "../../../store/past/verifyWriter";
import { useBench } from "../../../store/plc/bench";
import { linkWords, scanLink } from "../../../store/plc/links";
import { useForbidden } from "../../../store/plc/plc";
import { travel } from "../../../store/plc/timeline";
import { drive, type ShownVerification } from "../../../store/verify/verify";
import { editInput, useVerifyRows } from "../../../store/verify/verifyRows";
import { askWhatIf } from "../../../store/verify/whatif";
import { t } from "../../../text";
import { CopyButton } from "../../../ui/CopyButton";
import { Icon } from "../../../ui/Icon";
import type { VerifyDifference, VerifyRow } from "../../../wire/types";
import type { Looked } from "./looked";
import { Uses } from "./Uses";

interface Props extends Looked {
  shown: ShownVerification;
  at: number;
  onChoose: (at: number) => void;
}

/** The difference in words and bits, and the actions for it. */
export function Facts({ shown, row, difference, at, onChoose }: Props) {
  const [uses, showUses] = useState(false);
  const differing = useVerifyRows((rows) => rows.differing);
  if (!row) return <Hint shown={shown} count={differing.length} />;
  const ordinal = differing.indexOf(row.index) + 1;
  return (
    <div className="vffact scroll" role="region" aria-label={t("verify.facts")}>
      <div className="row vffacthead">
        {difference ? (
          <span className="st unhandled">
            <Icon name="differs" />
            <b>{t("verify.difference", { at: ordinal, of: grouped(differing.length) })}</b>
          </span>
        ) : (
          <span className={`st ${row.compared ? "running" : "stopped"}`}>
            <Icon name={row.compared && row.kind !== "none" ? "check" : "minus"} />
            <b>{t(headOf(row))}</b>
          </span>
        )}
        <span className="faint cut">{whereOf(row, difference)}</span>
      </div>
      {row.differences.length > 1 && (
        <div className="row wrap vfothers" role="group" aria-label={t("verify.others")}>
          {row.differences.map((other, index) => (
            <button
              key={`${other.name} ${other.cause}`}
              type="button"
              className={`btn quiet sm mono${index === at ? " on" : ""}`}
              aria-pressed={index === at}
              onClick={() => onChoose(index)}
            >
              {other.name}
            </button>
          ))}
        </div>
      )}
      {difference && (difference.control !== "" || difference.monitor !== "") && (
        <Sides shown={shown} row={row} difference={difference} />
      )}
      <p className="muted">{difference ? difference.message : sayOf(row)}</p>
      {difference && <p className="muted">{t(`verify.cause.${difference.cause}`)}</p>}
      {row.disturbances.length > 0 && (
        <p className="muted">
          {t("verify.disturbed")}{" "}
          <span className="st halted">
            <Icon name="generated" small />
            {row.disturbances.join(", ")}
          </span>
        </p>
      )}
      {row.consequences.map(({ name, message }) => (
        <p key={name} className="muted">
          <b>{t(row.kind === "step" ? "verify.consequence" : "verify.told")}</b>: {message}
        </p>
      ))}
      {row.note && <p className="st halted">{row.note}</p>}
      {row.next && (
        <p className="faint">
          {t("verify.next.statement", { file: row.next.file, line: row.next.line, instance: row.next.instance })}
        </p>
      )}
      <Deeds shown={shown} row={row} difference={difference} uses={uses} onUses={() => showUses(!uses)} />
      {uses && <Uses row={row} />}
    </div>
  );
}

const whereOf = (row: VerifyRow, difference: VerifyDifference | null) =>
  [
    difference?.name,
    t("verify.scan", { scan: grouped(row.scan) }),
    row.call > 1 || row.call === 1 ? t("verify.call", { call: row.call }) : null,
    difference?.place ? t("verify.line", { line: difference.place.line }) : null,
  ]
    .filter(Boolean)
    .join(", ");

function headOf({ compared, kind, consequences }: VerifyRow) {
  if (!compared) return "verify.notcompared";
  if (kind === "none") return "verify.notrun";
  if (consequences.length === 0) return "verify.same";
  return kind === "step" ? "verify.consequences" : "verify.told";
}

function sayOf(row: VerifyRow): string {
  if (row.consequences.length > 0) return t(row.kind === "step" ? "verify.consequences.about" : "verify.told.about");
  if (!row.compared) return t("verify.notcompared.about");
  if (row.kind === "none") return t("verify.notrun.about");
  return t(isEdited(row) ? "verify.same.edited" : "verify.same.about");
}

function Hint({ shown, count }: { shown: ShownVerification; count: number }) {
  return (
    <div className="vffact">
      <p className="muted">{sayOfAll(shown.info, count)}</p>
      {shown.info.first_difference && <p className="muted">{shown.info.first_difference.message}</p>}
      <p className="faint">{t("verify.hint.keys")}</p>
    </div>
  );
}

function sayOfAll(info: ShownVerification["info"], kept: number): string {
  const { compared, differing } = info;
  if (kept > 0) return t("verify.hint.differs", { count: grouped(kept) });
  if (differing > 0) return t("verify.hint.forgotten", { count: grouped(differing) });
  if (ranIn(info) > 0) return t("verify.hint.same");
  return t(compared > 0 ? "verify.hint.idle" : "verify.hint.none");
}

interface SidesProps {
  shown: ShownVerification;
  row: VerifyRow;
  difference: VerifyDifference;
}

/** A, A' on recorded inputs, A' on set inputs: values and bits. */
function Sides({ shown, row, difference }: SidesProps) {
  const name = useBench((bench) => bench.instance?.name ?? "");
  const output = row.outputs[difference.name];
  const type: ValueType = { type: difference.type, kind: difference.kind, size: difference.size };
  const set = output?.set ?? null;
  return (
    <div className="bitrows">
      <Side
        who="A"
        type={type}
        hex={difference.control}
        beside={difference.monitor}
        says={shown.info.source === "trace" ? shown.info.trace : (shown.record?.instance ?? name)}
      />
      <Side
        who="A′"
        type={type}
        hex={difference.monitor}
        beside={difference.control}
        says={t(difference.cause === "input" ? "verify.says.expected" : "verify.says.recorded")}
      />
      {output && (
        <Side
          who="A′"
          type={type}
          hex={set ?? ""}
          beside={difference.control}
          says={t(set === null ? "verify.says.set.not" : "verify.says.set")}
        />
      )}
      {set !== null && output && resultOf(output, "set") === difference.control && (
        <p className="muted vfverdict">{t("verify.set.explains")}</p>
      )}
    </div>
  );
}

interface SideProps {
  who: string;
  type: ValueType;
  hex: string;
  beside: string;
  says: string;
}

function Side({ who, type, hex, beside, says }: SideProps) {
  const groups = hex === "" ? null : bitsBeside(hex, beside, type.kind);
  return (
    <div className="bitrow">
      <span>{who}</span>
      <b className="mono cut" title={shownValue(type, hex || null).text}>
        {shownValue(type, hex || null).text}
      </b>
      <code>
        {groups?.map((group, at) => (
          // biome-ignore lint/suspicious/noArrayIndexKey: bits never change places
          <span key={at} className="nibble">
            {group.map(({ a, differs }, bit) =>
              // biome-ignore lint/suspicious/noArrayIndexKey: as above
              differs ? <u key={bit}>{a}</u> : <span key={bit}>{a}</span>,
            )}
          </span>
        ))}
      </code>
      <span className="cut">
        {says}
        {who === "A" && groups && differingBits(groups) > 0 && (
          <span className="faint">, {t("verify.bits", { count: differingBits(groups) })}</span>
        )}
      </span>
    </div>
  );
}

interface DeedsProps {
  shown: ShownVerification;
  row: VerifyRow;
  difference: VerifyDifference | null;
  uses: boolean;
  onUses: () => void;
}

function Deeds({ shown, row, difference, uses, onUses }: DeedsProps) {
  const forbidden = useForbidden("travel");
  const isTrace = shown.info.source === "trace";
  const track = useVerifyRows((rows) => rows.track);
  const variable = variableOf(difference, track);
  // The differing input is the one to try a different value for.
  const first = difference && difference.name in row.inputs ? difference.name : Object.keys(row.inputs)[0];
  if (shown.record) return null;

  async function tryOthers(): Promise<void> {
    if (shown.info.memory !== "set") await drive({ memory: "set" });
    if (first !== undefined) editInput(row, first);
  }

  return (
    <div className="row wrap">
      <button
        type="button"
        className="btn sm"
        disabled={first === undefined}
        title={first === undefined ? t("verify.try.none") : t("verify.try.about")}
        onClick={() => void tryOthers()}
      >
        {t("verify.try")}
      </button>
      {!isTrace && (
        <>
          <button
            type="button"
            className="btn quiet sm"
            disabled={forbidden !== null}
            title={forbidden ?? t("verify.goto.about")}
            onClick={() => void travel(row.scan)}
          >
            <Icon name="past" small />
            {t("verify.goto")}
          </button>
          <button
            type="button"
            className="btn quiet sm"
            disabled={variable === null}
            title={variable === null ? t("verify.writer.none") : t("writer.title", { path: variable })}
            onClick={() => variable !== null && void showWriterOf(row, difference, variable)}
          >
            <Icon name="cmd" small />
            {t("writer.menu")}
          </button>
          <CopyButton
            label={t("link.copy")}
            {...linkWords()}
            className="btn quiet sm"
            text={() => scanLink(row.scan, "verification")}
          />
        </>
      )}
      {!isTrace && (
        <button
          type="button"
          className="btn quiet sm"
          title={t("whatif.about")}
          onClick={() => void askWhatIf(row, difference)}
        >
          <Icon name="branch" small />
          {t("whatif.show")}
        </button>
      )}
      <button type="button" className="btn quiet sm" aria-expanded={uses} onClick={onUses}>
        <Icon name={uses ? "chev-d" : "chev-r"} small />
        {t("verify.uses")}
      </button>
    </div>
  );
}
