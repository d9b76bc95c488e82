import { useEffect, useRef } from "react";
import type { Check } from "../logic/errors/catalogue";

interface Props {
  label: string;
  check: Check;
  onToggle: () => void;
  disabled?: boolean;
}

/** A box that is on, off, or half: on for some of its items. */
export function Checkbox({ label, check, onToggle, disabled }: Props) {
  const box = useRef<HTMLInputElement>(null);
  useEffect(() => {
    if (box.current) box.current.indeterminate = check === "some";
  }, [check]);
  return (
    <input
      ref={box}
      type="checkbox"
      className="box"
      aria-label={label}
      checked={check === "all"}
      disabled={disabled}
      tabIndex={-1}
      onClick={(event) => event.stopPropagation()}
      onChange={onToggle}
    />
  );
}
