/** The menu of a drawing, by the right mouse button, by the menu key, or by M: Shift+F10 is a step back. */

import type { KeyboardEvent, MouseEvent } from "react";
import type { DrawnPart } from "../../../../logic/graphic/sheet";
import { toggleBreakpointHere } from "../../../../store/debug/debugKeys";
import { t } from "../../../../text";
import { useMenu } from "../../../../ui/Menu";
import type { Cursor } from "./cursor";
import { cursorAt } from "./find";
import { menuOf } from "./menu";
import { type Forcing, forcingAt, NO_FORCING } from "./operand";
import type { useChosen } from "./useChosen";
import type { useEditing } from "./useEditing";

interface Drawing {
  path: string;
  drawn: readonly DrawnPart[];
  readOnly: boolean;
  sheet: { current: HTMLElement | null };
  /** The id of the element of a cursor. */
  idOf: (cursor: Cursor) => string;
}

interface Does {
  choosing: Pick<ReturnType<typeof useChosen>, "holds" | "severalAt">;
  editing: Pick<ReturnType<typeof useEditing>, "can" | "put" | "refuse">;
  go: (to: Cursor) => void;
  /** What a key does; false where it does nothing. */
  press: (key: string, at: Cursor) => boolean;
  /** The text of what is copied or cut; null where there is nothing. */
  take: (what: "copy" | "cut", at: Cursor) => string | null;
}

export function useDrawingMenu({ path, drawn, readOnly, sheet, idOf }: Drawing, does: Does) {
  const { choosing, editing, go, press, take } = does;
  const { open, menu } = useMenu(t("graphic.menu"));
  /** The browser does not give its clipboard. */
  const refused = () => editing.refuse("graphic.menu.unpasted");

  function show(at: Cursor, point: { x: number; y: number }): void {
    const part = drawn[at.rung];
    const opened = (forcing: Forcing) => {
      const items = menuOf(part, at.place, {
        ...{ readOnly, several: choosing.severalAt(at), forcing, press: pressAt(at) },
        can: (key) => editing.can(key, at),
      });
      if (items.length > 0) open(items, point);
    };
    forcingAt(path, part, at.place).then(opened, () => opened(NO_FORCING));
  }

  function pressAt(at: Cursor): (key: string) => void {
    return (key) => {
      // The keys act where the drawing has the focus; a field that opens takes it then.
      sheet.current?.focus();
      if (key === "Ctrl+C" || key === "Ctrl+X" || key === "Ctrl+V") clip(key, at).catch(refused);
      else if (key === "F9") toggleBreakpointHere();
      else press(key, at);
    };
  }

  /** What a key does by an event of the browser's, which no menu can give. */
  async function clip(key: "Ctrl+C" | "Ctrl+X" | "Ctrl+V", at: Cursor): Promise<void> {
    if (key === "Ctrl+V") return void editing.put(at, await navigator.clipboard.readText());
    const text = take("copy", at);
    if (text === null) return;
    await navigator.clipboard.writeText(text);
    if (key === "Ctrl+X") take("cut", at);
  }

  function onContextMenu(event: MouseEvent): void {
    if (event.target instanceof HTMLInputElement) return;
    event.preventDefault();
    const at = cursorAt(drawn, event);
    if (!at) return;
    // What was chosen stays where the click is in it: the menu is of all that.
    if (!choosing.holds(at)) go(at);
    show(at, { x: event.clientX, y: event.clientY });
  }

  /** Whether the key opens the menu, at the element of the cursor. */
  function byKey({ key, shiftKey, ctrlKey, altKey }: KeyboardEvent, cursor: Cursor): boolean {
    if (key !== "ContextMenu" && (key.toLowerCase() !== "m" || shiftKey || ctrlKey || altKey)) return false;
    const row = `[data-index="${cursor.rung}"] .netbody`;
    const element = document.getElementById(idOf(cursor)) ?? sheet.current?.querySelector(row) ?? sheet.current;
    const box = element?.getBoundingClientRect();
    if (box) show(cursor, { x: box.left, y: box.bottom });
    return true;
  }

  return { menu, onContextMenu, byKey };
}
