import { type ReactNode, useState } from "react";
import {
  changeElement,
  KINDS,
  type PanelElement,
  removeElement,
  SCALED,
  SIZES,
  TONED,
  TONES,
} from "../../logic/operator/panel";
import { editPanel } from "../../store/operator/panels";
import { complete } from "../../store/plc/completion";
import { t } from "../../text";
import { Field } from "../../ui/Field";
import { Icon } from "../../ui/Icon";
import { PathField } from "../../ui/PathField";

interface Props {
  path: string;
  element: PanelElement;
  onRemoved: () => void;
}

const PLACE = ["column", "row", "width", "height"] as const;

/** What the selected element is: its kind, its variable, its scale and its place. */
export function ElementForm({ path, element, onRemoved }: Props) {
  const { id, kind } = element;
  const change = (next: Partial<PanelElement>) => editPanel(path, (panel) => changeElement(panel, id, next));
  return (
    <section className="opform" aria-label={t("operator.form")}>
      <h3>{t("operator.form")}</h3>
      <label className="field">
        <span>{t("operator.kind")}</span>
        <select
          className="inp"
          value={kind}
          onChange={({ target }) => {
            const next = KINDS.find((each) => each === target.value) ?? kind;
            const [width, height] = SIZES[next];
            change({ kind: next, width: Math.max(width, element.width), height: Math.max(height, element.height) });
          }}
        >
          {KINDS.map((each) => (
            <option key={each} value={each}>
              {t(`operator.kind.${each}`)}
            </option>
          ))}
        </select>
      </label>
      <Entry value={element.path} onEntered={(next) => change({ path: next.trim() })}>
        {({ value, onChange }) => (
          <div className="field">
            <span>{t("operator.variable")}</span>
            <PathField
              label={t("operator.variable")}
              value={value}
              onChange={onChange}
              complete={complete}
              placeholder={t("operator.variable.example")}
            />
          </div>
        )}
      </Entry>
      <Entry value={element.label} onEntered={(label) => change({ label })}>
        {(entry) => <Field label={t("operator.label")} {...entry} />}
      </Entry>
      {TONED.includes(kind) && (
        <label className="field">
          <span>{t("operator.tone")}</span>
          <select
            className="inp"
            value={element.tone ?? "normal"}
            onChange={({ target }) => {
              const tone = TONES.find((each) => each === target.value);
              change({ tone: tone === "normal" ? undefined : tone });
            }}
          >
            {TONES.map((each) => (
              <option key={each} value={each}>
                {t(`operator.tone.${each}`)}
              </option>
            ))}
          </select>
        </label>
      )}
      {SCALED.includes(kind) && (
        <div className="opfour">
          <NumberEntry label={t("operator.low")} value={element.low} onChange={(low) => change({ low })} />
          <NumberEntry label={t("operator.high")} value={element.high} onChange={(high) => change({ high })} />
        </div>
      )}
      <div className="opfour">
        {PLACE.map((each) => (
          <NumberEntry
            key={each}
            label={t(`operator.${each}`)}
            value={element[each] + (each === "column" || each === "row" ? 1 : 0)}
            onChange={(value) => change({ [each]: each === "column" || each === "row" ? value - 1 : value })}
          />
        ))}
      </div>
      <button
        type="button"
        className="btn sm"
        onClick={() => {
          editPanel(path, (panel) => removeElement(panel, id));
          onRemoved();
        }}
      >
        <Icon name="trash" small />
        {t("operator.remove")}
      </button>
    </section>
  );
}

interface EntryProps {
  value: string;
  onEntered: (value: string) => void;
  children: (field: { value: string; onChange: (value: string) => void }) => ReactNode;
}

/** A field whose text counts once it is entered, by Enter or by leaving it: half an address is a different address, and others
 * operate the panel meanwhile. */
function Entry({ value, onEntered, children }: EntryProps) {
  const [typed, setTyped] = useState<string | null>(null);
  function enter(): void {
    if (typed !== null && typed !== value) onEntered(typed);
    setTyped(null);
  }
  return (
    <div
      className="opentry"
      onKeyDown={({ key, defaultPrevented }) => {
        if (key === "Enter" && !defaultPrevented) enter();
        if (key === "Escape") setTyped(null);
      }}
      onBlur={({ currentTarget, relatedTarget }) => currentTarget.contains(relatedTarget) || enter()}
    >
      {children({ value: typed ?? value, onChange: setTyped })}
    </div>
  );
}

interface NumberProps {
  label: string;
  value: number;
  onChange: (value: number) => void;
}

function NumberEntry({ label, value, onChange }: NumberProps) {
  const entered = (text: string) => text.trim() !== "" && Number.isFinite(Number(text)) && onChange(Number(text));
  return (
    <Entry value={String(value)} onEntered={entered}>
      {(entry) => <Field label={label} {...entry} mono />}
    </Entry>
  );
}
