import type { ReactNode } from "react";
import { Icon, type IconName } from "./Icon";

interface EmptyProps {
  title: string;
  about: string;
  ways: readonly WayProps[];
  /** Actions to begin with, beside the text. */
  children?: ReactNode;
}

/** The content of an empty panel: what belongs there, and how to begin. */
export function Empty({ title, about, ways, children }: EmptyProps) {
  return (
    <div className="empty">
      <div>
        <h3>{title}</h3>
        <p>{about}</p>
        <div className="ways">
          {ways.map((way) => (
            <Way key={way.strong} {...way} />
          ))}
        </div>
      </div>
      {children && <div>{children}</div>}
    </div>
  );
}

interface WayProps {
  icon: IconName;
  strong: string;
  rest: string;
}

function Way({ icon, strong, rest }: WayProps) {
  return (
    <div className="way">
      <Icon name={icon} />
      <span>
        <b>{strong}</b> {rest}
      </span>
    </div>
  );
}
