import { useId } from "react";
import {
  type Entry,
  type Format,
  inWords,
  isText,
  limits,
  reformat,
  type Trouble,
} from "../../../logic/errors/details";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import type { ErrorDetail } from "../../../wire/types";

interface ControlProps {
  detail: ErrorDetail;
  entry: Entry;
  trouble: Trouble | null;
  onEntry: (entry: Entry) => void;
}

const FORMATS = ["hex", "decimal", "text"] as const;
const labelOf = (detail: ErrorDetail) => detail.description || detail.name;
const hasFormats = (detail: ErrorDetail) => detail.control === "Edit" && !isText(detail);
const isSpin = (detail: ErrorDetail) => detail.control === "Spin" && detail.base === 10;

/** A detail in the panel: a list of choices, or a number field beside its name. */
export function Control(props: ControlProps) {
  const { detail, entry, trouble, onEntry } = props;
  const id = useId();
  if (detail.control === "List") return <Choices {...props} />;
  return (
    <span className="detailrow">
      <label className="muted" htmlFor={id}>
        {labelOf(detail)}
      </label>
      <NumberInput {...props} id={id} small />
      {hasFormats(detail) && (
        <select
          className="inp sm"
          aria-label={`${labelOf(detail)}: ${t("entry.format")}`}
          value={entry.format}
          onChange={(event) => onEntry(reformat(detail, entry, event.target.value as Format))}
        >
          {FORMATS.map((format) => (
            <option key={format} value={format}>
              {t(`entry.format.${format}`)}
            </option>
          ))}
        </select>
      )}
      {detail.adds && <span className="hint">{t("errors.adds.number")}</span>}
      {trouble && <Refused id={`${id}-why`} trouble={trouble} />}
    </span>
  );
}

function Choices({ detail, entry, onEntry }: ControlProps) {
  const choices = detail.choices ?? [];
  const chosen = choices.find((choice) => choice.id === entry.text);
  return (
    <label className="detailrow choices">
      <span className="muted">{labelOf(detail)}</span>
      <select
        className="inp sm"
        value={entry.text}
        onChange={(event) => onEntry({ ...entry, text: event.target.value })}
      >
        {choices.map((choice) => (
          <option key={choice.id} value={choice.id}>
            {choice.description}
            {choice.address ? ` (${choice.address})` : ""}
          </option>
        ))}
      </select>
      {typeof chosen?.adds === "number" && <span className="hint">{t("errors.adds", { count: chosen.adds })}</span>}
    </label>
  );
}

interface NumberProps extends ControlProps {
  id: string;
  small?: boolean;
}

function NumberInput({ id, detail, entry, trouble, onEntry, small }: NumberProps) {
  const { low, high } = limits(detail, entry.format);
  const range = high ? t("errors.range", { minimum: low, maximum: high }) : "";
  const spin = isSpin(detail);
  return (
    <input
      id={id}
      className={`inp mono ${small ? "sm " : ""}${spin ? "spin" : "free"}${trouble ? " bad" : ""}`}
      type={spin ? "number" : "text"}
      min={detail.minimum ?? undefined}
      max={detail.maximum ?? undefined}
      maxLength={isText(detail) ? (detail.maximum ?? undefined) : undefined}
      value={entry.text}
      title={[range, detail.address].filter(Boolean).join(" · ")}
      spellCheck={false}
      autoComplete="off"
      aria-invalid={trouble !== null}
      aria-describedby={trouble ? `${id}-why` : undefined}
      onChange={(event) => onEntry({ ...entry, text: event.target.value })}
    />
  );
}

function Refused({ id, trouble }: { id: string; trouble: Trouble }) {
  return (
    <span className="hint bad" id={id} role="alert">
      <Icon name="error" small />
      <span>{inWords(trouble)}</span>
    </span>
  );
}

/** A detail on its page of the dialog: a table of choices, or a number field with its range. */
export function RoomyControl(props: ControlProps) {
  const { detail, entry, trouble, onEntry } = props;
  const id = useId();
  if (detail.control === "List") return <ChoiceTable {...props} />;
  const { low, high } = limits(detail, entry.format);
  return (
    <div className="roomy">
      <label className="muted" htmlFor={id}>
        {labelOf(detail)}
      </label>
      <span className="row">
        <NumberInput {...props} id={id} />
        {hasFormats(detail) && (
          <span className="seg" role="group" aria-label={`${labelOf(detail)}: ${t("entry.format")}`}>
            {FORMATS.map((format) => (
              <button
                key={format}
                type="button"
                className={format === entry.format ? "on" : ""}
                aria-pressed={format === entry.format}
                onClick={() => onEntry(reformat(detail, entry, format))}
              >
                {t(`entry.format.${format}`)}
              </button>
            ))}
          </span>
        )}
        {high && <span className="hint">{t("errors.range", { minimum: low, maximum: high })}</span>}
        {detail.adds && <span className="hint">{t("errors.adds.number")}</span>}
      </span>
      {trouble && <Refused id={`${id}-why`} trouble={trouble} />}
    </div>
  );
}

function ChoiceTable({ detail, entry, onEntry }: ControlProps) {
  const group = useId();
  const choices = detail.choices ?? [];
  const adds = choices.some((choice) => typeof choice.adds === "number");
  return (
    <fieldset className={`picklist${adds ? " adds" : ""}`}>
      <legend>{labelOf(detail)}</legend>
      <div className="pl plh" aria-hidden="true">
        <span />
        <span>{t("errors.choices")}</span>
        <span>{t("errors.detailbit")}</span>
        {adds && <span>{t("errors.adds.short")}</span>}
      </div>
      <div className="plrows">
        {choices.map((choice) => (
          <label key={choice.id} className={`pl${choice.id === entry.text ? " on" : ""}`}>
            <input
              type="radio"
              className="box radio"
              name={group}
              checked={choice.id === entry.text}
              onChange={() => onEntry({ ...entry, text: choice.id })}
            />
            <span className="cut" title={choice.description}>
              {choice.description}
            </span>
            <span className="mono">{choice.address}</span>
            {adds && <span className="mono">{typeof choice.adds === "number" ? `+${choice.adds}` : ""}</span>}
          </label>
        ))}
      </div>
    </fieldset>
  );
}
