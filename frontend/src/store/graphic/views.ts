/** How each file is shown: as text, as a drawing of its networks, or both beside each other. */

import { create } from "zustand";
import { networksIn } from "../../logic/graphic/networks";
import { keep, recall } from "../page/localStorage";

type View = "text" | "graphic" | "both";

const KEY = "views";
const VIEWS: readonly string[] = ["text", "graphic", "both"];

const useViews = create<{ of: Readonly<Record<string, View>> }>(() => ({ of: known() }));

function known(): Record<string, View> {
  const kept = Object.entries(recall<Record<string, View>>(KEY, {}));
  return Object.fromEntries(kept.filter(([, view]) => VIEWS.includes(view)));
}

export function showAs(path: string, view: View): void {
  useViews.setState(({ of }) => ({ of: { ...of, [path]: view } }));
  keep(KEY, useViews.getState().of);
}

/** Whether a text has ladder diagrams. */
export const hasRungs = (text: string): boolean => /^[ \t]*RUNG\b/im.test(text) && networksIn(text).length > 0;

/** The view of a file: where it has ladder diagrams the drawing, until somebody chooses; else the text. */
export function useViewOf(path: string, text: string): View {
  const chosen = useViews(({ of }) => of[path] ?? "graphic");
  return hasRungs(text) ? chosen : "text";
}
