/** Keys of the whole window. Captured before Monaco, which would keep F8 and others to itself. */

import { GROUPS } from "./commands";

const BOUND = new Map(
  Object.values(GROUPS)
    .flat()
    .flatMap(({ keys, run }) => keys?.split("|").map((name) => [name, run] as const) ?? []),
);

/** What the browser would do with these is wanted nowhere: print, save the page. */
const BROWSERS = ["Ctrl+P", "Ctrl+S"];

/** Keys that others follow, as in `Ctrl+K Ctrl+S`. */
const FIRST = new Set([...BOUND.keys()].flatMap((name) => (name.includes(" ") ? (name.split(" ")[0] ?? []) : [])));
const HELD = ["Control", "Meta", "Alt", "Shift"];

export function installKeys(): () => void {
  let before = "";
  const onKeyDown = (event: KeyboardEvent) => {
    if (HELD.includes(event.key)) return;
    const name = nameOf(event);
    const both = BOUND.get(`${before} ${name}`);
    before = FIRST.has(name) ? name : "";
    if (both || before !== "") {
      // The editor has keys of its own that begin so: it is to see both, and would else wait for the second one.
      event.preventDefault();
      if (document.querySelector("dialog[open]") === null) both?.();
      return;
    }
    const run = BOUND.get(name);
    if (!run || (name.length === 1 && isTyping(event.target))) return;
    const asked = document.querySelector("dialog[open]") !== null;
    if (asked && !BROWSERS.includes(name)) return;
    event.preventDefault();
    event.stopPropagation();
    if (!asked) run();
  };
  addEventListener("keydown", onKeyDown, true);
  return () => removeEventListener("keydown", onKeyDown, true);
}

function nameOf({ key, ctrlKey, metaKey, altKey, shiftKey }: KeyboardEvent): string {
  const isSign = key.length === 1 && key.toUpperCase() === key.toLowerCase(); // its Shift depends on the keyboard
  return [
    ctrlKey || metaKey ? "Ctrl+" : "",
    altKey ? "Alt+" : "",
    shiftKey && !isSign ? "Shift+" : "",
    key.length === 1 ? key.toUpperCase() : key,
  ].join("");
}

const isTyping = (target: EventTarget | null) =>
  target instanceof HTMLElement && target.closest("input, textarea, select, [role=textbox], .monaco-editor") !== null;
