interface Props {
  value: string;
  onChange: (value: string) => void;
  id?: string;
  label?: string;
  placeholder?: string;
  bad?: boolean;
  disabled?: boolean;
  title?: string;
}

/** A field for a count; a visible label is beside it, or the label is only its accessible name. */
export function NumberField({ value, onChange, id, label, placeholder, bad = false, disabled, title }: Props) {
  return (
    <input
      id={id}
      className={`inp sm mono number${bad ? " bad" : ""}`}
      aria-label={label}
      aria-invalid={bad}
      placeholder={placeholder}
      title={title}
      inputMode="numeric"
      value={value}
      disabled={disabled}
      spellCheck={false}
      autoComplete="off"
      onChange={(event) => onChange(event.target.value)}
    />
  );
}
