import { Fragment } from "react";
import { grouped } from "../../../logic/format/numbers";
import { useWidths } from "../../../store/page/columns";
import { openFile } from "../../../store/page/navigate";
import { useOnline, usePlc } from "../../../store/plc/plc";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { roomFor, useColumns } from "../../../ui/useColumns";
import { send } from "../../../wire/send";
import type { Violation } from "../../../wire/types";

/** Subrange violations that the embedded checks found while the program ran. A click goes to the source. */
export function DiagnosticsPanel() {
  const { violations, dropped, count } = usePlc((plc) => plc.diagnostics);
  const online = useOnline();
  return (
    <div className="pane flexcol" data-pane="diagnostics">
      {violations.length === 0 ? (
        <p className="lonely faint">{t("diagnostics.none")}</p>
      ) : (
        <>
          <div className="sub">
            <span>{t("diagnostics.count", { count: grouped(count) })}</span>
            {dropped > 0 && (
              <span className="st warning cut" role="status">
                <Icon name="warning" small />
                {t("diagnostics.dropped", { dropped: grouped(dropped) })}
              </span>
            )}
            <span className="grow" />
            <button
              type="button"
              className="btn quiet sm"
              disabled={!online}
              title={t("diagnostics.clear.hint")}
              onClick={() => void send({ type: "clear_diagnostics" })}
            >
              {t("diagnostics.clear")}
            </button>
          </div>
          <List violations={violations} />
        </>
      )}
    </div>
  );
}

const LOOK = { what: "", instance: "", times: "num", scans: "num scans" };

function List({ violations }: { violations: readonly Violation[] }) {
  const { style, grip } = useColumns(useWidths("diagnostics"));
  const room = { "--scans": roomFor(violations.map(scansOf)), "--place": roomFor(violations.map(placeOf)) };
  return (
    <div className="grid scroll problems violations" data-columns style={{ ...style, ...room }}>
      <div className="gr h">
        {(["what", "instance", "times", "scans"] as const).map((column) => (
          <span key={column} className={LOOK[column]}>
            {t(`diagnostics.${column}`)}
            {grip(column, t(`diagnostics.${column}`))}
          </span>
        ))}
        <span>{t("diagnostics.where")}</span>
      </div>
      <ul aria-label={t("diagnostics.list")}>
        {violations.map((violation, number) => (
          // entries keep their place until all are cleared
          // biome-ignore lint/suspicious/noArrayIndexKey: two paths of calls may look the same where they are cut
          <li key={number}>
            <Row violation={violation} />
            {violation.calls.length > 0 && <Calls violation={violation} />}
          </li>
        ))}
      </ul>
    </div>
  );
}

/** Who called, the outermost first. A click goes to the call. */
function Calls({ violation: { calls, cut } }: { violation: Violation }) {
  return (
    <div className="calls faint">
      <span>{t("diagnostics.calledfrom")}</span>
      {cut && <span title={t("diagnostics.cut")}>…</span>}
      {calls.map(({ pou, instance, method, file, line, column }, level) => (
        // biome-ignore lint/suspicious/noArrayIndexKey: a path never changes
        <Fragment key={level}>
          {(cut || level > 0) && <span aria-hidden="true">›</span>}
          <button type="button" className="link mono" onClick={() => openFile(file, line, column)}>
            {`${instance && method ? `${instance}.${method}` : instance || pou} ${file}:${line}`}
          </button>
        </Fragment>
      ))}
    </div>
  );
}

/** The violation in the language of the page. */
function inWords(violation: Violation): string {
  if (violation.variable === "EN_CHECK") return t("diagnostics.encheck");
  const { target, low, high } = violation;
  const variable = target ? t("diagnostics.bound", { target, variable: violation.variable }) : violation.variable;
  const value = violation.beyond ? t("diagnostics.beyond", { value: violation.value }) : violation.value;
  return t("diagnostics.outside", { variable, value, low, high });
}

const placeOf = ({ file, line, column }: Violation) => `${file}:${line}:${column}`;

const scansOf = ({ first_scan: first, last_scan: last }: Violation) =>
  first === last ? grouped(first) : `${grouped(first)}–${grouped(last)}`;

function Row({ violation }: { violation: Violation }) {
  const { file, line, column } = violation;
  const text = inWords(violation);
  const scans = scansOf(violation);
  return (
    <button type="button" className="gr" onClick={() => openFile(file, line, column)}>
      <span className="st warning cut" title={text}>
        <Icon name="warning" small />
        <span className="cut">{text}</span>
      </span>
      <span className="mono cut" title={violation.instance || violation.pou}>
        {violation.instance || violation.pou}
      </span>
      <span className="num mono" title={t("diagnostics.inscans", { scans })}>
        {grouped(violation.times)}
      </span>
      <span className="num mono muted scans">{scans}</span>
      <span className="mono muted cut" title={placeOf(violation)}>
        {placeOf(violation)}
      </span>
    </button>
  );
}
