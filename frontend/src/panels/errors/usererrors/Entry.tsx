import { useId, useState } from "react";
import { Icon } from "../../../ui/Icon";

interface Common {
  label: string;
  value: string;
  /** The problem with the entry, in the server's words. */
  wrong?: string | undefined;
  /** The language of the entry, for screen readers and fonts. */
  language?: string;
}

interface EntryProps extends Common {
  /** Called with every key. */
  onChange?: (value: string) => void;
  /** Called when the field is left; until then the entry stays as typed. */
  onLeave?: (value: string) => void;
  mono?: boolean;
  placeholder?: string;
  title?: string;
  offers?: readonly string[];
}

/** A text field with its name above and its problem below. */
export function Entry({
  label,
  value,
  wrong,
  language,
  onChange,
  onLeave,
  mono,
  placeholder,
  title,
  offers,
}: EntryProps) {
  const [typed, setTyped] = useState<string | null>(null);
  const id = useId();
  const type = (text: string) => (onLeave ? setTyped(text) : onChange?.(text));
  const leave = () => {
    if (typed !== null) onLeave?.(typed);
    setTyped(null);
  };
  return (
    <div className="field">
      <label htmlFor={id}>{label}</label>
      <input
        id={id}
        className={`inp${mono ? " mono" : ""}${wrong ? " bad" : ""}`}
        value={typed ?? value}
        lang={language}
        title={title}
        placeholder={placeholder}
        spellCheck={false}
        autoComplete="off"
        list={offers ? `${id}-offers` : undefined}
        aria-invalid={wrong !== undefined}
        aria-describedby={wrong ? `${id}-wrong` : undefined}
        onChange={(event) => type(event.target.value)}
        onBlur={leave}
        onKeyDown={(event) => event.key === "Enter" && leave()}
      />
      {offers && (
        <datalist id={`${id}-offers`}>
          {offers.map((offer) => (
            <option key={offer} value={offer} />
          ))}
        </datalist>
      )}
      <Wrong id={`${id}-wrong`} message={wrong} />
    </div>
  );
}

/** A text area of several lines. */
export function Words({ label, value, wrong, language, onChange }: Common & { onChange: (value: string) => void }) {
  const id = useId();
  return (
    <div className="field">
      <label htmlFor={id}>{label}</label>
      <textarea
        id={id}
        className="inp uewords"
        rows={2}
        value={value}
        lang={language}
        aria-invalid={wrong !== undefined}
        onChange={(event) => onChange(event.target.value)}
      />
      <Wrong id={`${id}-wrong`} message={wrong} />
    </div>
  );
}

interface ChooseProps extends Common {
  options: Readonly<Record<string, string>>;
  onChange: (value: string) => void;
  wide?: boolean;
}

/** A choice between a few values; a value that is none of them is shown as it is. */
export function Choose({ label, value, wrong, options, onChange, wide }: ChooseProps) {
  const id = useId();
  return (
    <div className={`field${wide ? " wide" : ""}`}>
      <label htmlFor={id}>{label}</label>
      <select
        id={id}
        className={`inp${wrong ? " bad" : ""}`}
        value={value}
        aria-invalid={wrong !== undefined}
        aria-describedby={wrong ? `${id}-wrong` : undefined}
        onChange={(event) => onChange(event.target.value)}
      >
        {!(value in options) && <option value={value}>{value}</option>}
        {Object.entries(options).map(([each, text]) => (
          <option key={each} value={each}>
            {text}
          </option>
        ))}
      </select>
      <Wrong id={`${id}-wrong`} message={wrong} />
    </div>
  );
}

/** Announced politely, because it changes with every key. */
export function Wrong({ id, message }: { id?: string; message: string | undefined }) {
  return (
    <span id={id} className="hint bad" aria-live="polite">
      {message && (
        <>
          <Icon name="error" small />
          <span>{message}</span>
        </>
      )}
    </span>
  );
}
