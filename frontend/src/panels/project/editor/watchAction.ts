/** Adds the name at the caret or the selection to the watch table: by menu, by key, or by dragging it there. */

import { pathsIn } from "../../../logic/format/paths";
import { ownerOf, pouAt } from "../../../logic/plc/sourceLines";
import { loadNames, seenAsNow } from "../../../store/debug/seenAs";
import { useMembers } from "../../../store/plc/members";
import { shownText } from "../../../store/project/shownProgram";
import { addToWatch } from "../../../store/watch/watchlist";
import { t } from "../../../text";
import { type editor, KeyCode, KeyMod } from "./monaco";

export function addWatchAction(code: editor.IStandaloneCodeEditor, path: string): void {
  code.addAction({
    id: "scanbench.watch",
    label: t("watch.addone"),
    contextMenuGroupId: "navigation",
    // Not Ctrl+Shift+W, which closes the window of every browser.
    keybindings: [KeyMod.CtrlCmd | KeyMod.Alt | KeyCode.KeyW],
    run: () => void watchNames(path, code.getPosition()?.lineNumber ?? 1, selectedNames(code) ?? nameAtCaret(code)),
  });
}

const FAR_ENOUGH = 4;

/** A selection can be dragged from the editor into the watch table. Monaco implements dragging with mouse events, so the drag
 * and drop of the browser is not available. */
export function dragToWatch(code: editor.IStandaloneCodeEditor, host: HTMLElement, path: string): () => void {
  const events = new AbortController();
  const { signal } = events;
  let carried: { names: string[]; line: number; x: number; y: number } | null = null;
  let pane: Element | null = null;

  function begin(event: MouseEvent): void {
    const position = code.getTargetAtClientPoint(event.clientX, event.clientY)?.position;
    const selection = code.getSelection();
    if (event.button !== 0 || !position || !selection?.containsPosition(position)) return;
    const names = selectedNames(code);
    if (names) carried = { names, line: selection.startLineNumber, x: event.clientX, y: event.clientY };
  }

  function over(event: MouseEvent): Element | null {
    if (!carried || Math.hypot(event.clientX - carried.x, event.clientY - carried.y) < FAR_ENOUGH) return null;
    return document.elementFromPoint(event.clientX, event.clientY)?.closest("[data-pane=watch]") ?? null;
  }

  function move(event: MouseEvent): void {
    if (!carried) return;
    const now = over(event);
    if (now === pane) return;
    pane?.classList.remove("dropping");
    now?.classList.add("dropping");
    pane = now;
  }

  function end(event: MouseEvent): void {
    const dropped = over(event);
    pane?.classList.remove("dropping");
    pane = null;
    if (dropped && carried) void watchNames(path, carried.line, carried.names);
    carried = null;
  }

  host.addEventListener("mousedown", begin, { capture: true, signal });
  window.addEventListener("mousemove", move, { capture: true, signal });
  window.addEventListener("mouseup", end, { capture: true, signal });
  return () => events.abort();
}

export function selectedNames(code: editor.IStandaloneCodeEditor): string[] | null {
  const selection = code.getSelection();
  const text = selection && code.getModel()?.getValueInRange(selection);
  const names = text ? pathsIn(text) : [];
  return names.length > 0 ? names : null;
}

/** The path of names around the caret: `belt[1].run`. */
export function nameAtCaret(code: editor.IStandaloneCodeEditor): string[] {
  const position = code.getPosition();
  const line = position && code.getModel()?.getLineContent(position.lineNumber);
  for (const match of line?.matchAll(/%?[\p{L}_][\p{L}\d_]*(?:\[[\d, ]+\]|\.%?[\p{L}\d_]+)*/gu) ?? []) {
    const from = match.index + 1;
    if (position && from <= position.column && position.column <= from + match[0].length) return [match[0]];
  }
  return [];
}

async function watchNames(path: string, line: number, names: readonly string[]): Promise<void> {
  if (names.length > 0) addToWatch(await pathsOf(path, line, names));
}

/** A name in a POU means a variable of the instance whose values the text shows, or a global one. */
export async function pathsOf(path: string, line: number, names: readonly string[]): Promise<string[]> {
  const { pous, text } = shownText(path);
  const found = pouAt(pous, path, line, text);
  const pou = found && ownerOf(pous, found);
  if (pou) await loadNames(pou.name);
  return names.map((name) => pathIn(pou?.name, name));
}

function pathIn(pou: string | undefined, name: string): string {
  const { of } = useMembers.getState();
  const instance = pou === undefined ? undefined : (seenAsNow(pou) ?? pou);
  const root = /^[^.[^]+/.exec(name)?.[0].toUpperCase();
  const has = (owner: string) => of.get(owner)?.some((symbol) => symbol.name.toUpperCase() === root) ?? false;
  // If the name is not known, its row in the watch table says so.
  const isOwn = instance !== undefined && !name.startsWith("%") && (has(instance) || !has(""));
  return isOwn ? `${instance}.${name}` : name;
}
