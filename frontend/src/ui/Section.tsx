import type { ReactNode } from "react";
import { Icon } from "./Icon";
import "./section.css";

interface Props {
  /** For a class of its own. */
  id: string;
  title: string;
  meta?: ReactNode;
  actions?: ReactNode;
  open: boolean;
  onToggle: () => void;
  children: ReactNode;
}

/** A section of the left side that can be folded. */
export function Section({ id, title, meta, actions, open, onToggle, children }: Props) {
  return (
    <section className={`sect sect-${id}`} aria-label={title}>
      <div className="sh">
        <button type="button" className="shtitle" aria-expanded={open} onClick={onToggle}>
          <Icon name={open ? "chev-d" : "chev-r"} className="tw" />
          <h2>{title}</h2>
        </button>
        <span className="grow" />
        {meta !== undefined && <span className="meta cut">{meta}</span>}
        {actions}
      </div>
      {open && children}
    </section>
  );
}
