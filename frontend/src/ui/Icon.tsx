import { drawings, type IconName } from "./drawings";

export type { IconName } from "./drawings";

interface Props {
  name: IconName;
  small?: boolean;
  className?: string;
}

/** One icon in the colour of its text; never the only carrier of a meaning, so hidden from screen readers. */
export function Icon({ name, small = false, className = "" }: Props) {
  return (
    <svg className={`i${small ? " s" : ""} ${className}`} viewBox="0 0 16 16" aria-hidden="true">
      {drawings[name]}
    </svg>
  );
}
