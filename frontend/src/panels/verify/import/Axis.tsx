import { changeAxis, GAPS, SAMPLED, UNITS } from "../../../logic/verify/traceImport";
import { useDocuments } from "../../../store/project/documents";
import { chooseRange, editMapping, useTraceImport } from "../../../store/verify/traceImport";
import { t } from "../../../text";
import type { TraceMapping, UploadedTrace } from "../../../wire/types";

interface Props {
  trace: UploadedTrace;
  mapping: TraceMapping;
}

const RANGES = new Set(["program", "function_block", "function", "method"]);

/** What the rows mean, what to do about missing scans, and what is compared. */
export function Axis({ trace, mapping }: Props) {
  const pou = useTraceImport((state) => state.pou);
  const pous = useDocuments((documents) => documents.pous);
  return (
    <div className="row wrap tiaxis">
      <label>
        <span className="faint">{t("import.trace.axis.in")}</span>
        <select
          className="inp sm"
          value={mapping.axis}
          onChange={(event) => editMapping(changeAxis(mapping, event.target.value, trace.columns))}
        >
          <option value="">{t("import.trace.axis.row")}</option>
          {trace.columns.map((column) => (
            <option key={column} value={column}>
              {t("import.trace.axis.column", { column })}
            </option>
          ))}
        </select>
      </label>
      {mapping.axis !== "" && (
        <label>
          <span className="faint">{t("import.trace.unit")}</span>
          <select
            className="inp sm"
            value={mapping.unit}
            onChange={(event) => editMapping({ ...mapping, unit: event.target.value as TraceMapping["unit"] })}
          >
            {UNITS.map((unit) => (
              <option key={unit} value={unit}>
                {t(`import.trace.unit.${unit}`)}
              </option>
            ))}
          </select>
        </label>
      )}
      <label>
        <span className="faint">{t("import.trace.gaps")}</span>
        <select
          className="inp sm"
          value={mapping.gaps}
          onChange={(event) => editMapping({ ...mapping, gaps: event.target.value as TraceMapping["gaps"] })}
        >
          {GAPS.map((gaps) => (
            <option key={gaps} value={gaps}>
              {t(`import.trace.gaps.${gaps}`)}
            </option>
          ))}
        </select>
      </label>
      <label>
        <span className="faint">{t("import.trace.sampled")}</span>
        <select
          className="inp sm"
          value={mapping.sampled}
          onChange={(event) => editMapping({ ...mapping, sampled: event.target.value as TraceMapping["sampled"] })}
        >
          {SAMPLED.map((sampled) => (
            <option key={sampled} value={sampled}>
              {t(`import.trace.sampled.${sampled}`)}
            </option>
          ))}
        </select>
      </label>
      <label>
        <span className="faint">{t("import.trace.range")}</span>
        <select className="inp sm" value={pou} onChange={(event) => chooseRange(event.target.value)}>
          <option value="">{t("import.trace.range.all")}</option>
          {pous
            .filter(({ kind }) => RANGES.has(kind))
            .map(({ name }) => (
              <option key={name} value={name}>
                {name}
              </option>
            ))}
        </select>
      </label>
    </div>
  );
}
