/** The palette: whether it is open, and with which text it begins; and everything that can be done by name. */
import { create } from "zustand";

/** What the text of the palette begins with while commands are looked for; else files and names are. */
export const COMMANDS = ">";

/** And while only symbols of the project are. */
export const SYMBOLS = "#";

/** `begins` is null while the palette is closed. `unasked`: the language server did not answer, so names were not looked at. */
export const usePalette = create<{ begins: string | null; unasked: boolean }>(() => ({ begins: null, unasked: false }));

export const showPalette = (begins: string | null) => usePalette.setState({ begins });

/** Whether the page of keys is open. */
export const useKeys = create<{ open: boolean }>(() => ({ open: false }));

export const showKeys = (open: boolean) => useKeys.setState({ open });

export interface Command {
  /** In the language of the page. */
  label: string;
  /** As they are written on a keyboard: `Ctrl+Shift+B`. */
  keys?: string;
  run: () => void;
}

const offered = new Set<() => readonly Command[]>();

/** Offers commands, as they are at the moment, until the returned function is called. */
export function offerCommands(now: () => readonly Command[]): () => void {
  offered.add(now);
  return () => void offered.delete(now);
}

/** All that is offered, each label once. */
export function commandsNow(): Command[] {
  const found = new Map<string, Command>();
  for (const now of offered)
    for (const command of now()) if (!found.has(command.label)) found.set(command.label, command);
  return [...found.values()];
}
