/** Panels in windows of their own: each has an address, so it survives a reload, goes to a second screen, and does not need the window that it came from. */
import type { DockviewApi, IDockviewPanel } from "dockview-react";
import { loneIn, lonePath } from "../logic/plc/links";
import { isPanel, pageOf } from "../store/page/navigate";
import { useBench } from "../store/plc/bench";
import { fileOf, openFilePanel, openPagePanel, showFixedPanel } from "./layout";

/** What these pages show was chosen in their window, and no address knows it. */
const BOUND: readonly string[] = ["record", "compare", "campaign", "whatif", "cross", "calls", "start"];

export const canPopOut = (panel: string) => !BOUND.includes(panel) && loneIn(location) !== panel;

/** Shows the panel for which a window was opened, and tells the title of the tab in front from then on. */
export function beginWith(dock: DockviewApi, id: string, onTitle: (title: string) => void): void {
  const tell = () => onTitle(dock.activePanel?.title ?? "");
  dock.onDidActivePanelChange(tell);
  dock.onDidAddPanel((panel) => void panel.api.onDidTitleChange(tell));
  const file = fileOf(id);
  const page = pageOf(id);
  if (file !== undefined) openFilePanel(dock, file);
  else if (page !== undefined) openPagePanel(dock, page);
  else if (isPanel(id)) showFixedPanel(dock, id);
  else dock.addPanel({ id: "start", component: "start" });
}

/** Opens the panel in a window as large as it is now, or shows the one that it has. */
export function popOut({ id, group }: Pick<IDockviewPanel, "id" | "group">): void {
  const instance = useBench.getState().instance?.id;
  if (instance === undefined || !canPopOut(id)) return;
  const address = lonePath(instance, id);
  const { width, height } = group.element.getBoundingClientRect();
  const size = `popup,width=${Math.max(480, Math.round(width))},height=${Math.max(360, Math.round(height))}`;
  const opened = window.open("", `scanbench ${address}`, size);
  if (opened && opened.location.href === "about:blank") opened.location.href = address;
  opened?.focus();
}

export function popOutActive(dock: DockviewApi): void {
  if (dock.activePanel) popOut(dock.activePanel);
}
