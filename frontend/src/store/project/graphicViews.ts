/** How each file is shown: as text, as a drawing of its networks, or both beside each other. */

import { create } from "zustand";
import { keep, recall } from "../page/localStorage";

export type View = "text" | "graphic" | "both";

const KEY = "views";
const VIEWS: readonly string[] = ["text", "graphic", "both"];

export const useViews = create<{ of: Readonly<Record<string, View>> }>(() => ({ of: known() }));

function known(): Record<string, View> {
  const kept = Object.entries(recall<Record<string, View>>(KEY, {}));
  return Object.fromEntries(kept.filter(([, view]) => VIEWS.includes(view)));
}

export function showAs(path: string, view: View): void {
  useViews.setState(({ of }) => ({ of: { ...of, [path]: view } }));
  keep(KEY, useViews.getState().of);
}

/** The view of a file that has networks: the drawing, until somebody chooses. */
export const useViewOf = (path: string): View => useViews(({ of }) => of[path] ?? "graphic");
