/** How each file is shown: as text, as a drawing of its networks, or both beside each other. */

import { create } from "zustand";
import { partsIn } from "../../logic/graphic/charts";
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

/** What a text has that is drawn: rungs, function block diagrams or charts, several of them (`mixed`), or nothing. */
type DrawnKind = "rung" | "network" | "chart" | "mixed" | null;

/** Those of the last texts: they are asked for whenever a caret moves. */
const kinds = new Map<string, DrawnKind>();

export function drawnKind(text: string): DrawnKind {
  const known = kinds.get(text);
  if (known !== undefined) return known;
  const found = /^[ \t]*(?:RUNG|NETWORK|STEP|INITIAL_STEP|TRANSITION)\b/im.test(text)
    ? partsIn(text).map(({ kind }) => kind)
    : [];
  const drawn = (["rung", "network", "chart"] as const).filter((kind) => found.includes(kind));
  const made = drawn.length > 1 ? "mixed" : (drawn[0] ?? null);
  if (kinds.size >= 8) kinds.clear();
  kinds.set(text, made);
  return made;
}

/** The view of a file: where it has something to draw the drawing, until somebody chooses; else the text. */
export function useViewOf(path: string, text: string): View {
  const chosen = useViews(({ of }) => of[path] ?? "graphic");
  return drawnKind(text) ? chosen : "text";
}

const FIT = "fit";

/** Whether drawings that are wider than the editor are made smaller. */
const useFitted = create<{ fitted: boolean }>(() => ({ fitted: recall(FIT, false) }));

export const useFit = () => useFitted(({ fitted }) => fitted);

export function fitDrawings(fitted: boolean): void {
  useFitted.setState({ fitted });
  keep(FIT, fitted);
}

const TOOLS = "drawingkeys";

/** Whether the keys of a drawing are shown as buttons below it. */
const useTools = create<{ shown: boolean }>(() => ({ shown: recall(TOOLS, true) }));

export const useShowsTools = () => useTools(({ shown }) => shown);

export function showTools(shown: boolean): void {
  useTools.setState({ shown });
  keep(TOOLS, shown);
}
