import { drawings, type IconName } from "./drawings";

export type { IconName } from "./drawings";

interface Props {
  name: IconName;
  small?: boolean;
  className?: string;
}

/** One icon in the colour of its text. Hidden from screen readers, because an icon is never the only sign of a meaning. */
export function Icon({ name, small = false, className = "" }: Props) {
  return (
    <svg className={`i${small ? " s" : ""} ${className}`} viewBox="0 0 16 16" aria-hidden="true">
      {drawings[name]}
    </svg>
  );
}
