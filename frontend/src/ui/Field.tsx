import { Icon } from "./Icon";

interface Props {
  label: string;
  value: string;
  onChange: (value: string) => void;
  /** Why the entry was refused; it stays as typed. */
  refused?: string | null;
  mono?: boolean;
  placeholder?: string;
  title?: string;
  /** A number is typed. */
  number?: boolean;
  /** Nobody may read what is typed. */
  secret?: boolean;
  /** Additional classes of the input. */
  look?: string;
}

/** A text field with its name above and, after a refusal, the reason below. */
export function Field({
  label,
  value,
  onChange,
  refused = null,
  mono = false,
  number = false,
  secret = false,
  look = "",
  ...rest
}: Props) {
  return (
    <label className="field">
      <span>{label}</span>
      <input
        className={`inp${mono ? " mono" : ""}${refused ? " bad" : ""}${look && ` ${look}`}`}
        type={secret ? "password" : number ? "number" : "text"}
        value={value}
        {...rest}
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
