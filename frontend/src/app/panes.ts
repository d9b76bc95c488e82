/** The panes of the window, which F6 goes through. */

const FOCUSABLE =
  "textarea.inputarea, [role=treegrid], [role=treeitem][tabindex='0'], [tabindex='0'], input, button:not([disabled])";

/** Moves the focus to the next visible pane, to the control that people use most there. */
export function cyclePanes(by: 1 | -1): void {
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
