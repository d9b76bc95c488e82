import { type KeyboardEvent, useState } from "react";
import { copied, networksOf, pasted } from "../../../../logic/graphic/clip";
import type { Around, Edit, Made } from "../../../../logic/graphic/edit";
import type { Place } from "../../../../logic/graphic/ladderLayout";
import { readRung } from "../../../../logic/graphic/ladderRead";
import { networksIn } from "../../../../logic/graphic/networks";
import { type DrawnPart, stopsOf } from "../../../../logic/graphic/sheet";
import type { TextKey } from "../../../../text";
import type { Cursor } from "./cursor";
import { canPress, madeOf } from "./made";
import { followed, type Named, opening } from "./reopened";
import { addPart, putParts, removeParts, switchParts, takeBack, writePart } from "./write";

interface Editing {
  path: string;
  drawn: readonly DrawnPart[];
  readOnly: boolean;
  /** Moves the cursor. */
  go: (to: Cursor) => void;
  /** What edits of a part need to know of its file. */
  around: (part: DrawnPart) => Around;
}

/** Edits the parts of a drawing by keys, or by what stands for one. */
export function useEditing({ path, drawn, readOnly, go, around }: Editing) {
  const [open, setNamed] = useState<Named | null>(null);
  const named = open && followed(open, drawn, around);
  if (named !== open) setNamed(named);
  const [refused, setRefused] = useState<TextKey | null>(null);

  /** Does an edit, or opens its field first. Whether there was one. `by`: the key that it is of, and what its part is by then. */
  function begin(at: number, made: Made, by?: Begun): boolean {
    setRefused(made && "refused" in made ? made.refused : null);
    if (!made) return false;
    if ("refused" in made) return true;
    const part = by?.part ?? drawn[at];
    const { naming } = made;
    const { key = "", place = made.place, typed = [] } = by ?? {};
    if (naming && part) setNamed(opening({ ...made, naming }, { key, place, typed }, { drawn, at, part }));
    else {
      setNamed(null);
      if (part) writePart(path, part.found, made.text, made.declares);
    }
    go({ rung: at, place: made.place });
    return true;
  }

  /** What the key of this name does at the cursor: `c`, `Shift+F`, `Ctrl+I`. False where it does nothing. `text`: what was just written for the part. */
  function press(key: string, { rung: at, place }: Cursor, text?: string): boolean {
    const known = drawn[at];
    if (!known || readOnly) return false;
    const part = text === undefined ? known : written(known, text);
    const lower = key.toLowerCase();
    const alias = ALIASES[part.kind][lower];
    if (alias) return press(alias, { rung: at, place }, text);
    if (lower === "ctrl+z" || lower === "ctrl+y") takeBack(path, lower === "ctrl+y");
    else if (part.kind !== "chart" && lower === "ctrl+i") return added(at, part, false);
    else if (part.kind !== "chart" && lower === "ctrl+shift+i") return added(at, part, true);
    else if (part.kind !== "chart" && (lower === "ctrl+delete" || emptied(part, key))) return removed(at, part);
    else if (lower === "ctrl+l") go({ rung: at, place: [] });
    else if (lower === "ctrl+d") return put({ rung: at, place }, copied(part, place) ?? "");
    else if (part.kind !== "chart" && lower === "ctrl+/") switchParts(path, [part.found]);
    else
      return !lower.startsWith("ctrl+") && begin(at, madeOf(part, key, place, around), { part, key, place, typed: [] });
    setRefused(null);
    return true;
  }

  function added(at: number, part: DrawnPart, above: boolean): boolean {
    addPart(path, part.found, above);
    go({ rung: above ? at : at + 1, place: [] });
    return true;
  }

  function removed(at: number, part: DrawnPart): boolean {
    removeParts(path, [part.found]);
    go({ rung: Math.max(0, Math.min(at, drawn.length - 2)), place: [] });
    return true;
  }

  /** Puts a text in after the cursor: networks below this one, elements after this one. Refused where it is neither. */
  function put({ rung: at, place }: Cursor, text: string): boolean {
    const part = drawn[at];
    if (!part || readOnly) return false;
    const networks = networksOf(text);
    if (networks === null) return begin(at, pasted(part, place, text, around(part)));
    if (part.kind === "chart") return begin(at, { refused: "graphic.refused.paste.chart" });
    setRefused(null);
    putParts(path, part.found, networks);
    go({ rung: at + networks.length, place: [] });
    return true;
  }

  /** What is copied at the cursor; null where there is nothing. */
  function copy({ rung: at, place }: Cursor): string | null {
    const part = drawn[at];
    return part ? copied(part, place) : null;
  }

  function cut(cursor: Cursor): string | null {
    const part = drawn[cursor.rung];
    const text = copy(cursor);
    if (!part || text === null || readOnly) return null;
    if (networksOf(text) !== null || !part.readable) removed(cursor.rung, part);
    else press("Delete", cursor);
    return text;
  }

  /** Takes what was typed into the field. Where the cursor is then; null where the text means nothing there. */
  function take(typed: string): Edit | null {
    const part = named && !named.lost && drawn[named.rung];
    const made = part ? named.naming.taken(typed, around(part)) : null;
    if (named && part && made)
      begin(named.rung, made, { ...named.opened, typed: [...named.opened.typed, typed], part });
    return made;
  }

  /** Whether a key means something at the cursor. */
  function can(key: string, { rung: at, place }: Cursor): boolean {
    const part = drawn[at];
    return part !== undefined && canPress(part, key, place, around);
  }

  return { named, refused, refuse: setRefused, can, press, begin, take, copy, cut, put, leave: () => setNamed(null) };
}

/** What an edit is of. */
interface Begun {
  part: DrawnPart;
  key: string;
  place: Place;
  typed: readonly string[];
}

/** A part with the text that was just written for it, before it is drawn. */
function written(part: DrawnPart, text: string): DrawnPart {
  const found = { ...part.found, text };
  if (part.kind !== "rung") return { ...part, found };
  const read = readRung({ ...found, ...networksIn(text)[0], text });
  return { ...part, found, path: read.kind === "rung" ? read.path : null };
}

/** Keys of CODESYS that mean the same; those that a browser keeps to itself have none. */
const ALIASES: Record<DrawnPart["kind"], Readonly<Record<string, string>>> = {
  rung: {
    ...{ "ctrl+a": "o", "ctrl+b": "f", "ctrl+shift+e": "Shift+F", "ctrl+e": "e", "ctrl+m": "s", "ctrl+r": "w" },
  },
  network: { "ctrl+a": "a", "ctrl+b": "f", "ctrl+shift+e": "Shift+F", "ctrl+e": "e", "ctrl+u": "+" },
  chart: {},
};

/** A key with what is held, as `press` takes it. */
export function keyOf({ key, ctrlKey, altKey, shiftKey, code }: KeyboardEvent): string {
  const shifted = shiftKey && (ctrlKey || /^(?:[a-z]|F\d+)$/i.test(key));
  // `#` needs Shift on many keyboards; where it has a key of its own, that key with Shift is another character.
  if (altKey ? key === "#" : shiftKey && code === "Backslash" && key === "'") return "Shift+#";
  return `${ctrlKey ? "Ctrl+" : ""}${altKey ? "Alt+" : ""}${shifted ? "Shift+" : ""}${key}`;
}

const emptied = (part: DrawnPart, key: string) =>
  (key === "Delete" || key === "Backspace") && part.readable && stopsOf(part).length === 0;
