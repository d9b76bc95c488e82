import { Icon, type IconName } from "./Icon";

interface Props {
  icon: IconName;
  /** The accessible name; with a key in brackets it is the tooltip too. */
  label: string;
  hint?: string;
  onClick: () => void;
  disabled?: boolean;
  small?: boolean;
  className?: string;
}

/** A button with only an icon: always with an accessible name and a tooltip. */
export function IconButton({ icon, label, hint, onClick, disabled, small, className = "" }: Props) {
  return (
    <button
      type="button"
      className={`ib${small ? " sm" : ""} ${className}`}
      aria-label={label}
      title={hint ? `${label} (${hint})` : label}
      disabled={disabled}
      onClick={onClick}
    >
      <Icon name={icon} />
    </button>
  );
}
