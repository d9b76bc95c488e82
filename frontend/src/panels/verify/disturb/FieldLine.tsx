import { type ReactNode, useId } from "react";

interface Props {
  label: string;
  /** The control that the label names has this id. */
  children: (id: string) => ReactNode;
}

/** A name and its fields beside it. */
export function FieldLine({ label, children }: Props) {
  const id = useId();
  return (
    <div className="fieldline">
      <label htmlFor={id} className="faint">
        {label}
      </label>
      <span className="controls">{children(id)}</span>
    </div>
  );
}
