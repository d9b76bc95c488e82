/** Keys of the whole window. Captured before Monaco, which would keep F8 and others to itself. */

import { toggleBreakpointHere } from "../store/debug/debugKeys";
import { restartByKey, singleScan, toggleRun } from "../store/debug/run";
import { runToCaret, step } from "../store/debug/stepping";
import { returnToLive, stepBack } from "../store/plc/timeline";
import { build, save, useDocuments } from "../store/project/documents";
import { showsRan } from "../store/project/shownProgram";

type Handler = (event: KeyboardEvent) => void;

const keys: Record<string, Handler> = {
  F5: toggleRun,
  "Ctrl+Shift+F5": restartByKey,
  "Ctrl+Alt+Pause": () => void step("pause"),
  F9: toggleBreakpointHere,
  F10: () => void step("next"),
  "Ctrl+F10": runToCaret,
  "Shift+F10": () => void step("stepBack"),
  F11: () => void step("stepIn"),
  "Shift+F11": () => void step("stepOut"),
  "Alt+F5": () => void step("reverseContinue"),
  F8: singleScan,
  "Shift+F8": stepBack,
  "Shift+Escape": returnToLive,
  F6: () => cyclePanes(1),
  "Shift+F6": () => cyclePanes(-1),
  "Ctrl+S": () => {
    const { active } = useDocuments.getState();
    if (active && !showsRan(active)) void save(active);
  },
  "Ctrl+Shift+B": () => void build(),
};

export function installKeys(): () => void {
  const onKeyDown = (event: KeyboardEvent) => {
    const name = [
      event.ctrlKey || event.metaKey ? "Ctrl+" : "",
      event.altKey ? "Alt+" : "",
      event.shiftKey ? "Shift+" : "",
      event.key.length === 1 ? event.key.toUpperCase() : event.key,
    ].join("");
    const handler = keys[name];
    if (!handler || document.querySelector("dialog[open]")) return;
    event.preventDefault();
    event.stopPropagation();
    handler(event);
  };
  addEventListener("keydown", onKeyDown, true);
  return () => removeEventListener("keydown", onKeyDown, true);
}

const FOCUSABLE =
  "textarea.inputarea, [role=treegrid], [role=treeitem][tabindex='0'], [tabindex='0'], input, button:not([disabled])";

/** Moves the focus to the next visible pane, to the control that people use most there. */
function cyclePanes(by: 1 | -1): void {
  const panes = [...document.querySelectorAll<HTMLElement>("[data-pane]")].filter((pane) => pane.offsetParent !== null);
  const now = panes.findIndex((pane) => pane.contains(document.activeElement));
  for (let i = 1; i <= panes.length; i += 1) {
    const pane = panes[(now + by * i + panes.length * 2) % panes.length];
    const target = pane && firstFocus(pane);
    if (!target) continue;
    target.focus();
    return;
  }
}

function firstFocus(pane: HTMLElement): HTMLElement | null {
  for (const selector of FOCUSABLE.split(", ")) {
    const found = pane.querySelector<HTMLElement>(selector);
    if (found && (found.offsetParent !== null || found.matches("textarea"))) return found;
  }
  return null;
}
