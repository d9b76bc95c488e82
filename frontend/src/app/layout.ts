/** The arrangement of panels: the default one, and the one kept in this browser. */
import type { AddPanelPositionOptions, DockviewApi, IDockviewPanel, SerializedDockview } from "dockview-react";
import { type PageName, pageOf } from "../store/page/navigate";

const FILE = "file:";

export function fileOf(panel: string): string | undefined {
  return panel.startsWith(FILE) ? panel.slice(FILE.length) : undefined;
}

/** Editor in the middle, watch and the wide tables below, error simulator at the right. */
export function standardLayout(dock: DockviewApi): void {
  dock.clear();
  const narrow = innerWidth < 1280;
  dock.addPanel({ id: "start", component: "start" });
  dock.addPanel({
    id: "errors",
    component: "errors",
    position: { referencePanel: "start", direction: "right" },
    initialWidth: narrow ? 372 : 420,
  });
  dock.addPanel({ id: "disturb", component: "disturb", position: { referencePanel: "errors" }, inactive: true });
  dock.addPanel({
    id: "watch",
    component: "watch",
    position: { referencePanel: "start", direction: "below" },
    initialHeight: innerHeight < 800 ? 248 : 340,
  });
  for (const id of [
    "trace",
    "steps",
    "verify",
    "forces",
    "problems",
    "search",
    "diagnostics",
    "log",
    "history",
    "console",
  ]) {
    dock.addPanel({ id, component: id, position: { referencePanel: "watch" }, inactive: true });
  }
  dock.getPanel("start")?.api.setActive();
}

const FIXED = [
  "errors",
  "disturb",
  "watch",
  "steps",
  "trace",
  "verify",
  "forces",
  "problems",
  "search",
  "diagnostics",
  "log",
  "history",
  "console",
];

/** Restores the kept layout if it fits this version of the page; else builds the default layout. */
export function restoreLayout(dock: DockviewApi, kept: unknown): void {
  if (kept !== null) {
    try {
      dock.fromJSON(kept as SerializedDockview);
      if (FIXED.every((id) => dock.getPanel(id))) return;
    } catch {
      // Kept by a different version of the page: use the default layout.
    }
  }
  standardLayout(dock);
}

/** Shows a file: in its own panel if it has one, else in a new panel beside the other files. */
export function openFilePanel(dock: DockviewApi, path: string): void {
  const known = dock.getPanel(FILE + path);
  if (known) toFront(known);
  else addFile(dock, path, false);
}

/** The dock puts the element of a panel in its place again even where it is there already, and what was in focus in it loses it. */
function toFront(panel: IDockviewPanel): void {
  const { activeElement: focused } = document;
  if (!panel.api.isActive) panel.api.setActive();
  if (focused instanceof HTMLElement && focused.isConnected && document.activeElement === document.body)
    focused.focus();
}

/** Opens a file that nobody asked for: a page that somebody opened meanwhile stays the one that is shown. */
export function offerFilePanel(dock: DockviewApi, path: string): void {
  if (pageShown(dock)) addFile(dock, path, true);
  else openFilePanel(dock, path);
}

/** Whether somebody looks at a page among the files. */
const pageShown = (dock: DockviewApi) =>
  dock.panels.some((panel) => central(panel.id) && pageOf(panel.id) && panel.api.isVisible);

function addFile(dock: DockviewApi, path: string, inactive: boolean): void {
  if (dock.getPanel(FILE + path)) return;
  const position = editorPlace(dock);
  dock.addPanel({ id: FILE + path, component: "editor", params: { path }, position, inactive });
  const start = dock.getPanel("start");
  if (start) dock.removePanel(start);
}

/** Shows a page: in its own panel if it has one, else in a new panel among the files. The page gets the whole dock until it is closed or reduced. */
export function openPagePanel(dock: DockviewApi, name: PageName): void {
  if (name === "help") {
    openHelp(dock);
    return;
  }
  const panel = dock.getPanel(name) ?? dock.addPanel({ id: name, component: name, position: editorPlace(dock) });
  panel.api.setActive();
  const start = dock.getPanel("start");
  if (start) dock.removePanel(start);
  if (!panel.api.isMaximized()) panel.api.maximize();
}

/** The help is read beside what it is about: at the right, with the error simulator; what is at the right itself is explained among the files. */
function openHelp(dock: DockviewApi): void {
  const known = dock.getPanel("help");
  if (dock.hasMaximizedGroup() && !known?.api.isMaximized()) dock.exitMaximizedGroup();
  const explained = dock.activePanel;
  const covers = known && explained && explained !== known && explained.group === known.group;
  if (covers) dock.removePanel(known);
  const panel = covers ? undefined : known;
  (panel ?? dock.addPanel({ id: "help", component: "help", ...helpPlace(dock, explained) })).api.setActive();
}

function helpPlace(dock: DockviewApi, explained?: IDockviewPanel): { position?: AddPanelPositionOptions } {
  const right = dock.getPanel("errors");
  const files = editorPlace(dock);
  const neighbour = right?.group === explained?.group ? files : right && { referencePanel: right };
  if (right && neighbour) return { position: neighbour };
  return explained ? { position: { referencePanel: explained, direction: "right" } } : {};
}

/** Gives the active panel the whole dock, or brings the others back. */
export function enlarge(dock: DockviewApi): void {
  if (dock.hasMaximizedGroup()) dock.exitMaximizedGroup();
  else dock.activePanel?.api.maximize();
}

/** A panel has the whole dock only while it is the active one; when somebody returns to it, it is as wide as before. */
export function widePanels(dock: DockviewApi): void {
  const wide = new Set<string>();
  dock.onDidMaximizedGroupChange(() => {
    const panel = dock.activePanel;
    if (!panel) return;
    if (panel.api.isMaximized()) wide.add(panel.id);
    else wide.delete(panel.id);
  });
  dock.onDidActivePanelChange(({ panel }) => {
    if (!panel || panel.api.isMaximized() === wide.has(panel.id)) return;
    if (wide.has(panel.id)) panel.api.maximize();
    else if (dock.hasMaximizedGroup()) dock.exitMaximizedGroup();
  });
}

/** Shows a fixed panel. If a page has the whole dock and hides the panel, the dock is divided again. */
export function showFixedPanel(dock: DockviewApi, name: string): void {
  // A window of its own begins with one panel only.
  const panel = dock.getPanel(name) ?? dock.addPanel({ id: name, component: name });
  if (dock.hasMaximizedGroup() && !panel.api.isMaximized()) dock.exitMaximizedGroup();
  panel.api.setActive();
}

/** Whether the panel is in the centre, among the files. */
const central = (id: string) => fileOf(id) !== undefined || (pageOf(id) !== undefined && id !== "help");

function editorPlace(dock: DockviewApi): AddPanelPositionOptions | undefined {
  const neighbour = dock.getPanel("start") ?? dock.panels.findLast((panel) => central(panel.id));
  if (neighbour) return { referencePanel: neighbour };
  return dock.getPanel("watch") ? { referencePanel: "watch", direction: "above" } : undefined;
}

/** Closes files; when none is left, the start page takes their place. */
export function closeFiles(dock: DockviewApi, which: (path: string) => boolean): void {
  for (const panel of [...dock.panels]) {
    const path = fileOf(panel.id);
    if (path !== undefined && which(path)) closeTab(dock, panel.id);
  }
}

/** Closes a file or a page. */
export function closeTab(dock: DockviewApi, id: string): void {
  const panel = dock.getPanel(id);
  if (!panel) return;
  if (pageOf(id) && panel.api.isMaximized()) dock.exitMaximizedGroup();
  const others = dock.panels.filter((other) => other.id !== id && central(other.id));
  if (others.length === 0 && central(id))
    dock.addPanel({ id: "start", component: "start", position: { referencePanel: panel } });
  dock.removePanel(panel);
}
