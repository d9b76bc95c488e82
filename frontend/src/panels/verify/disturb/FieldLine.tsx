import { type ReactNode, useId } from "react";

interface Props {
  label: string;
  /** The id of the control that the label belongs to. */
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
