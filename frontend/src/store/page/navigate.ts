/** Going to places: panels request it, the shell (which knows the dock) does it. */
import { create } from "zustand";

/** Panels at the bottom and at the right, which cannot be closed. */
export const PANELS = [
  "console",
  "diagnostics",
  "disturb",
  "errors",
  "forces",
  "history",
  "log",
  "problems",
  "search",
  "steps",
  "trace",
  "verify",
  "watch",
] as const;
type PanelName = (typeof PANELS)[number];
export const isPanel = (name: string): name is PanelName => PANELS.some((known) => known === name);
/** Pages in the centre, among the files: opened on request, closed like a file. */
const PAGES = [
  "sweep",
  "usererrors",
  "plcerrors",
  "record",
  "compare",
  "campaign",
  "whatif",
  "hardware",
  "versions",
  "rack",
  "memory",
  "cross",
  "calls",
  "communication",
  "help",
] as const;
export type PageName = (typeof PAGES)[number];

export const pageOf = (panel: string): PageName | undefined => PAGES.find((name) => name === panel);

interface Place {
  path: string;
  line: number;
  column: number;
  /** Counts, so that going to the same place twice works twice. */
  turn: number;
}

interface Navigation {
  /** The place for the caret in the editor of a file. */
  place: Place | null;
  /** Counts what somebody went to: places in files, and pages. */
  went: number;
}

export const useNavigation = create<Navigation>(() => ({ place: null, went: 0 }));

type Opener = {
  file: (path: string) => void;
  panel: (name: PanelName) => void;
  page: (name: PageName) => void;
};
let opener: Opener = { file: () => undefined, panel: () => undefined, page: () => undefined };

export function onNavigate(next: Opener): void {
  opener = next;
}

export function openFile(path: string, line?: number, column = 1): void {
  opener.file(path);
  if (line === undefined) return;
  useNavigation.setState(({ went }) => ({ place: { path, line, column, turn: went + 1 }, went: went + 1 }));
}

export function showPanel(name: PanelName): void {
  opener.panel(name);
}

export function openPage(name: PageName): void {
  opener.page(name);
  useNavigation.setState(({ went }) => ({ went: went + 1 }));
}
