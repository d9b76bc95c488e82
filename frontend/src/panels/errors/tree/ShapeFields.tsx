import { type ReactNode, useId } from "react";
import { HOWS, type readShape, type ShapeField, type ShapeForm, WHENS } from "../../../logic/errors/shapes";
import { useShape } from "../../../store/errors/shape";
import { setShape } from "../../../store/errors/simulator";
import { useDocuments } from "../../../store/project/documents";
import { t } from "../../../text";
import { ConditionBox } from "./ConditionBox";

type Troubles = ReturnType<typeof readShape>["troubles"];

/** When a fault begins and how it continues; "now" and "stays" is an ordinary Generate. */
export function ShapeFields() {
  const id = useId();
  const { form, troubles } = useShape();
  return (
    <div className="shape" role="group" aria-label={`${t("shape.when")}, ${t("shape.how")}`}>
      <div className="shaperow">
        <label htmlFor={`${id}-when`} className="faint">
          {t("shape.when")}
        </label>
        <select
          id={`${id}-when`}
          className="inp sm"
          value={form.when}
          onChange={(event) => setShape({ when: event.target.value as ShapeForm["when"] })}
        >
          {WHENS.map((when) => (
            <option key={when} value={when}>
              {t(`shape.when.${when}`)}
            </option>
          ))}
        </select>
        <WhenFields form={form} troubles={troubles} />
      </div>
      <div className="shaperow">
        <label htmlFor={`${id}-how`} className="faint">
          {t("shape.how")}
        </label>
        <select
          id={`${id}-how`}
          className="inp sm"
          value={form.how}
          onChange={(event) => setShape({ how: event.target.value as ShapeForm["how"] })}
        >
          {HOWS.map((how) => (
            <option key={how} value={how}>
              {t(`shape.how.${how}`)}
            </option>
          ))}
        </select>
        <HowFields form={form} troubles={troubles} />
      </div>
      <Complaint form={form} troubles={troubles} />
    </div>
  );
}

interface FieldsProps {
  form: ShapeForm;
  troubles: Troubles;
}

function WhenFields({ form, troubles }: FieldsProps) {
  const cursor = useDocuments((documents) => documents.cursor);
  const active = useDocuments((documents) => documents.active);
  switch (form.when) {
    case "scan":
      return <Count field="scan" form={form} label={t("shape.scan")} troubles={troubles} wide />;
    case "condition":
      return (
        <ConditionBox
          label={t("shape.condition")}
          value={form.condition}
          onChange={(condition) => setShape({ condition })}
        />
      );
    case "line":
      return (
        <>
          <input
            className={`inp sm mono place${form.place && troubles.place ? " bad" : ""}`}
            aria-label={t("shape.file")}
            placeholder="Main.st:12"
            value={form.place}
            spellCheck={false}
            onChange={(event) => setShape({ place: event.target.value })}
          />
          {active && cursor && (
            <button type="button" className="link" onClick={() => setShape({ place: `${active}:${cursor.line}` })}>
              {t("shape.useline", { line: cursor.line, file: active })}
            </button>
          )}
        </>
      );
    default:
      return null;
  }
}

function HowFields({ form, troubles }: FieldsProps) {
  const props = { form, troubles };
  const chance = useId();
  const times = (
    <Count field="times" label={t("shape.times")} placeholder={t("shape.times.endless")} {...props} wide>
      <span className="faint">{t("shape.times")}</span>
    </Count>
  );
  switch (form.how) {
    case "for":
      return <Count field="scans" label={t("shape.scans")} after={t("shape.scans")} {...props} />;
    case "intermittent":
      return (
        <>
          <Count field="scans" label={t("shape.on")} {...props}>
            <span className="faint">{t("shape.on")}</span>
          </Count>
          <Count field="period" label={t("shape.every")} after={t("shape.scans")} {...props}>
            <span className="faint">{t("shape.every")}</span>
          </Count>
          {times}
          <span className="row tightish">
            <input
              id={chance}
              type="checkbox"
              className="box"
              checked={form.chance}
              onChange={() => setShape({ chance: !form.chance })}
            />
            <label htmlFor={chance} className="faint">
              {t("shape.chance")}
            </label>
            {form.chance && (
              <Count field="seed" label={t("shape.seed")} {...props}>
                <span className="faint">{t("shape.seed")}</span>
              </Count>
            )}
          </span>
        </>
      );
    case "chance":
      return (
        <>
          <Count field="percent" label={t("shape.percent")} after={t("shape.percent.each")} {...props} />
          <Count field="scans" label={t("shape.on")} after={t("shape.scans")} {...props}>
            <span className="faint">{t("shape.on")}</span>
          </Count>
          {times}
          <Count field="seed" label={t("shape.seed")} {...props}>
            <span className="faint">{t("shape.seed")}</span>
          </Count>
        </>
      );
    case "chatter":
      return times;
    case "unacknowledged":
      return (
        <>
          <Count field="scans" label={t("shape.gone")} after={`${t("shape.scans")},`} {...props}>
            <span className="faint">{t("shape.gone")}</span>
          </Count>
          <span className="faint">{t("shape.acknowledge")}</span>
          <ConditionBox
            label={t("shape.acknowledge")}
            value={form.acknowledge}
            onChange={(acknowledge) => setShape({ acknowledge })}
          />
        </>
      );
    default:
      return null;
  }
}

interface CountProps extends FieldsProps {
  field: "scan" | "scans" | "period" | "times" | "seed" | "percent";
  label: string;
  placeholder?: string;
  after?: string;
  wide?: boolean;
  children?: ReactNode;
}

function Count({ field, label, form, troubles, placeholder, after, wide, children }: CountProps) {
  return (
    <span className="row tightish">
      {children}
      <input
        className={`inp sm mono ${wide ? "wide" : "count"}${form[field] && troubles[field] ? " bad" : ""}`}
        aria-label={label}
        aria-invalid={troubles[field] !== undefined}
        placeholder={placeholder}
        inputMode={field === "percent" ? "decimal" : "numeric"}
        value={form[field]}
        spellCheck={false}
        onChange={(event) => setShape({ [field]: event.target.value })}
      />
      {after && <span className="faint">{after}</span>}
    </span>
  );
}

/** The missing or wrong fields; red is used only for a wrong entry. */
function Complaint({ form, troubles }: FieldsProps) {
  const [field] = Object.keys(troubles) as ShapeField[];
  const key = field && troubles[field];
  if (!field || !key) return null;
  return <p className={`hint${form[field] === "" ? "" : " bad"}`}>{t(key)}</p>;
}
