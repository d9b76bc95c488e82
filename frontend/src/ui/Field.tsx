import { Icon } from "./Icon";

interface Props {
  label: string;
  value: string;
  onChange: (value: string) => void;
  /** Why the entry was not taken; it stays as typed. */
  refused?: string | null;
}

/** A line of text with its name above and, when refused, the reason below. */
export function Field({ label, value, onChange, refused = null }: Props) {
  return (
    <label className="field">
      <span>{label}</span>
      <input
        className={`inp${refused ? " bad" : ""}`}
        value={value}
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
