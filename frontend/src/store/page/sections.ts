/** Which sections of the left side are folded, as this browser keeps it. */
import { useState } from "react";
import { keep, recall } from "./localStorage";

export function useSection(id: string, initially = true): { open: boolean; onToggle: () => void } {
  const [open, setOpen] = useState(() => recall(`section.${id}`, initially));
  function onToggle(): void {
    keep(`section.${id}`, !open);
    setOpen(!open);
  }
  return { open, onToggle };
}
