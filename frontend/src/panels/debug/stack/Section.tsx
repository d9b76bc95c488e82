import { type ReactNode, useState } from "react";
import { keep, recall } from "../../../store/page/localStorage";
import { Icon } from "../../../ui/Icon";

interface Props {
  /** The key under which this browser stores whether the section is folded. */
  id: string;
  title: string;
  meta?: ReactNode;
  actions?: ReactNode;
  children: ReactNode;
}

/** A section of the left side that can be folded. */
export function Section({ id, title, meta, actions, children }: Props) {
  const [open, setOpen] = useState(() => recall(`section.${id}`, true));
  function toggle(): void {
    keep(`section.${id}`, !open);
    setOpen(!open);
  }
  return (
    <section className={`sect sect-${id}`} aria-label={title}>
      <div className="sh">
        <button type="button" className="shtitle" aria-expanded={open} onClick={toggle}>
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
