import { Icon } from "./Icon";

interface Props {
  label: string;
  value: string;
  onChange: (value: string) => void;
  /** Why the entry was refused; it stays as typed. */
  refused?: string | null;
  mono?: boolean;
  placeholder?: string;
}

/** A text field with its name above and, after a refusal, the reason below. */
export function Field({ label, value, onChange, refused = null, mono = false, placeholder }: Props) {
  return (
    <label className="field">
      <span>{label}</span>
      <input
        className={`inp${mono ? " mono" : ""}${refused ? " bad" : ""}`}
        value={value}
        placeholder={placeholder}
        spellCheck={false}
        autoComplete="off"
        aria-invalid={refused !== null}
        onChange={(event) => onChange(event.target.value)}
      />
      {refused && (
        <span className="hint bad" role="alert">
          <Icon name="error" small />
          {refused}
        </span>
      )}
    </label>
  );
}
