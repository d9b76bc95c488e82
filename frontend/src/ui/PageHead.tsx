import type { ReactNode } from "react";
import "./pagehead.css";

interface Props {
  title: string;
  /** The title is a name of the program. */
  name: boolean;
  children?: ReactNode;
}

/** The head of a page about one thing: what it is, and at the end what can be done there. */
export function PageHead({ title, name, children }: Props) {
  return (
    <div className="sub tall pagehead">
      <h2 className={name ? "mono" : ""}>{title}</h2>
      {children}
    </div>
  );
}
