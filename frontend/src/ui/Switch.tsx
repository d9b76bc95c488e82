import type { ReactNode } from "react";

interface Props {
  on: boolean;
  onToggle: () => void;
  children: ReactNode;
}

/** A switch that takes effect at once, with its label beside it. */
export function Switch({ on, onToggle, children }: Props) {
  return (
    <label className="switchrow">
      <input type="checkbox" role="switch" aria-checked={on} className="switch" checked={on} onChange={onToggle} />
      {children}
    </label>
  );
}
