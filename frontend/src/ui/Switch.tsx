import type { ReactNode } from "react";

interface Props {
  on: boolean;
  onToggle: () => void;
  children: ReactNode;
}

/** Something that is on or off at once, with its words beside it. */
export function Switch({ on, onToggle, children }: Props) {
  return (
    <label className="switchrow">
      <input type="checkbox" role="switch" aria-checked={on} className="switch" checked={on} onChange={onToggle} />
      {children}
    </label>
  );
}
