import { defaultDetails, detailsInWords, outOfRange } from "../../logic/catalogue";
import { grouped, wallTime } from "../../logic/numbers";
import { t } from "../../logic/text";
import { usePlc } from "../../store/plc";
import { setDetail, useSimulator } from "../../store/simulator";
import { Icon } from "../../ui/Icon";
import type { ErrorDetail, ErrorInfo } from "../../wire/types";

/** The selected error: what it means, where it shows, and what can be chosen before it is raised. */
export function Details({ error }: { error: ErrorInfo }) {
  const edited = useSimulator((state) => state.details[error.id]);
  const row = usePlc((plc) => plc.errors.get(error.id));
  const details = edited ?? defaultDetails(error);
  const fatal = error.severity === "fatal";
  const raised = row?.status === "generated" ? row : null;
  return (
    <section className="edetail" aria-label={t("errors.details")}>
      <div className="row">
        <b className="grow cut">{error.name}</b>
        <span className="chip plain" title={error.source || undefined}>
          <Icon name={error.verified ? "check" : "info"} />
          {t(error.verified ? "errors.verified" : "errors.unverified")}
        </span>
        <span className={`chip ${fatal ? "fatal" : "halted"}`}>
          <Icon name={fatal ? "fatal" : "warning"} />
          {t(fatal ? "errors.fatal" : "errors.nonfatal")}
        </span>
      </div>
      {error.description && <p className="muted">{error.description}</p>}
      {raised && (
        <p className="muted">
          {t("errors.raisedby", {
            by: raised.by ?? "",
            at: wallTime(raised.generated_at),
            scan: grouped(raised.generated_scan ?? 0),
          })}
          {raised.details && ` ${detailsInWords(error, raised.details)}`}
        </p>
      )}
      <div className="row wrap apart">
        <span className="kv">
          <span>
            {t("errors.code")}
            <b>{raised?.code ?? error.code}</b>
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
              value={details[detail.name] ?? ""}
              onChange={(value) => setDetail(error, detail.name, value)}
            />
          ))}
        </div>
      </div>
    </section>
  );
}

interface ControlProps {
  detail: ErrorDetail;
  value: string;
  onChange: (value: string) => void;
}

function Control({ detail, value, onChange }: ControlProps) {
  const label = detail.description || detail.name;
  const { minimum = null, maximum = null, base } = detail;
  if (detail.control === "List") {
    return (
      <label className="detailrow">
        <span className="muted">{label}</span>
        <select className="inp sm" value={value} onChange={(event) => onChange(event.target.value)}>
          {(detail.choices ?? []).map((choice) => (
            <option key={choice.id} value={choice.id}>
              {choice.description}
              {choice.address ? ` (${choice.address})` : ""}
            </option>
          ))}
        </select>
      </label>
    );
  }
  const limits = minimum !== null && maximum !== null ? t("errors.range", range(minimum, maximum, base)) : "";
  const bad = (minimum !== null || maximum !== null) && outOfRange(value, minimum, maximum, base);
  const spin = detail.control === "Spin" && base === 10;
  return (
    <label className="detailrow" title={[limits, detail.address].filter(Boolean).join(" · ")}>
      <span className="muted">{label}</span>
      <input
        className={`inp sm mono ${spin ? "spin" : "free"}${bad ? " bad" : ""}`}
        type={spin ? "number" : "text"}
        min={minimum ?? undefined}
        max={maximum ?? undefined}
        value={value}
        spellCheck={false}
        aria-invalid={bad}
        onChange={(event) => onChange(event.target.value)}
      />
      {bad && <span className="hint bad">{limits}</span>}
    </label>
  );
}

function range(minimum: number, maximum: number, base: number): { minimum: string; maximum: string } {
  const text = (value: number) => value.toString(base).toUpperCase();
  return { minimum: text(minimum), maximum: text(maximum) };
}
