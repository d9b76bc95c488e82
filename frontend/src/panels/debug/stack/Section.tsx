import type { ReactNode } from "react";
import { useSection } from "../../../store/page/sections";
import { Section as Folded } from "../../../ui/Section";

interface Props {
  /** The key under which this browser stores whether the section is folded. */
  id: string;
  title: string;
  meta?: ReactNode;
  actions?: ReactNode;
  children: ReactNode;
}

export function Section(props: Props) {
  return <Folded {...props} {...useSection(props.id)} />;
}
