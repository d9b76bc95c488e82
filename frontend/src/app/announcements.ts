/** What the dock says to who hears the page: by the names that are on the screen, in the page's language. */
import type { IDockviewPanel } from "dockview-react";
import { baseName } from "../logic/format/paths";
import { isPanel } from "../store/page/navigate";
import { t } from "../text";
import { fileOf } from "./layout";

interface Change {
  kind: "open" | "close" | "maximize" | "restore" | "float" | "dock" | "popout";
  panel: Pick<IDockviewPanel, "id" | "title">;
}

/** Null: nothing is said. A page that has just been made has no title yet; what it shows is said when the focus is there. */
export function announcement({ kind, panel }: Change): string | null {
  const name = nameOf(panel);
  if (name === null || kind === "float" || kind === "dock" || kind === "popout") return null;
  return t(`dock.${kind}`, { name });
}

function nameOf({ id, title }: Change["panel"]): string | null {
  const file = fileOf(id);
  if (file !== undefined) return baseName(file);
  if (isPanel(id)) return t(`panel.${id}`);
  return title === undefined || title === id ? null : title;
}
