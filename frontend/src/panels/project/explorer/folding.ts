/** Which folders of the explorer are open, and the row of a folder. */
import { useState } from "react";
import type { TreeRow } from "../../../ui/Tree";

export interface Folding {
  isOpen: (key: string) => boolean;
  toggle: (key: string) => void;
}

export function useFolding(initial: readonly string[]): Folding {
  const [open, setOpen] = useState<ReadonlySet<string>>(() => new Set(initial));
  return {
    isOpen: (key) => open.has(key),
    toggle: (key) =>
      setOpen((before) => {
        const next = new Set(before);
        if (!next.delete(key)) next.add(key);
        return next;
      }),
  };
}

export function folder(folding: Folding, key: string, name: string, count?: number): TreeRow {
  const open = folding.isOpen(key);
  return {
    key,
    level: 0,
    icon: "folder",
    label: name,
    name,
    meta: open || count === undefined ? undefined : count,
    open,
    onToggle: () => folding.toggle(key),
  };
}
