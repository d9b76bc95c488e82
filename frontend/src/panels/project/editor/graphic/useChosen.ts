/** Several elements of a part, or several parts, that are chosen at once: what keys and clicks choose, and what is done with them. */

import { type KeyboardEvent, useState } from "react";
import { networksOf, wholeText } from "../../../../logic/graphic/clip";
import type { Around, Made } from "../../../../logic/graphic/edit";
import type { Place } from "../../../../logic/graphic/ladderLayout";
import { between, branched, textOf, without } from "../../../../logic/graphic/select";
import type { DrawnPart } from "../../../../logic/graphic/sheet";
import { type Cursor, moved, sameElement } from "./cursor";
import type { Several } from "./menu";
import { putParts, removeParts, switchParts } from "./write";

export interface Chosen {
  /** One, whose elements are at `places`; without places whole parts. */
  parts: readonly number[];
  places: readonly Place[];
}

interface State extends Chosen {
  anchor: Cursor;
  /** An edit ends a selection: its places may mean something else. */
  drawn: readonly DrawnPart[];
}

interface Choosing {
  path: string;
  drawn: readonly DrawnPart[];
  readOnly: boolean;
  go: (to: Cursor) => void;
  begin: (at: number, made: Made) => boolean;
  around: (part: DrawnPart) => Around;
}

const range = (a: number, b: number) =>
  Array.from({ length: Math.abs(a - b) + 1 }, (_, index) => Math.min(a, b) + index);

const WAYS = ["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown", "Home", "End"];

export function useChosen({ path, drawn, readOnly, go, begin, around }: Choosing) {
  const [state, setState] = useState<State | null>(null);
  const chosen = state?.drawn === drawn ? state : null;
  const choose = (parts: readonly number[], places: readonly Place[], anchor: Cursor) =>
    setState(parts.length > 0 ? { parts, places, anchor, drawn } : null);
  const clear = () => setState(null);

  /** Chooses from where the selection began to a cursor. */
  function extend(anchor: Cursor, to: Cursor): void {
    const part = drawn[to.rung];
    const whole = to.rung !== anchor.rung || to.place.length === 0 || anchor.place.length === 0;
    if (whole) choose(range(anchor.rung, to.rung), [], anchor);
    else if (part) choose([to.rung], between(part, anchor.place, to.place), anchor);
    go(whole ? { rung: to.rung, place: [] } : to);
  }

  /** What Shift with an arrow, or Ctrl+Shift+A, chooses. False for other keys. */
  function byKey({ key, shiftKey, ctrlKey, altKey }: KeyboardEvent, cursor: Cursor): boolean {
    if (key === "Escape" && chosen) {
      clear();
      return true;
    }
    if (!shiftKey || altKey) return false;
    if (ctrlKey && key.toLowerCase() === "a") {
      choose(range(0, drawn.length - 1), [], { rung: 0, place: [] });
      return true;
    }
    if (!WAYS.includes(key)) return false;
    const anchor = chosen?.anchor ?? cursor;
    const vertical = key === "ArrowUp" ? -1 : key === "ArrowDown" ? 1 : 0;
    const parts = ctrlKey || cursor.place.length === 0 || (chosen !== null && chosen.places.length === 0);
    if (parts && vertical === 0) return false;
    const rung = Math.max(0, Math.min(drawn.length - 1, cursor.rung + vertical));
    const to = parts ? { rung, place: [] } : moved({ key, altKey: false, ctrlKey: false }, cursor, drawn);
    if (to) extend(anchor, to);
    return to !== null;
  }

  const holds = ({ rung, place }: Cursor) =>
    chosen?.parts.includes(rung) === true &&
    (chosen.places.length === 0 || chosen.places.some((each) => sameElement(each, place)));

  /** What is chosen together with a place, for its menu; null where it is alone. */
  function severalAt(at: Cursor): Several | null {
    if (!chosen || !holds(at)) return null;
    const { places } = chosen;
    const parts = wholes();
    const count = places.length > 0 ? places.length : parts.length;
    if (count < 2) return null;
    if (places.length > 0) return { count, of: "elements" };
    return { count, of: parts.every(({ kind }) => kind === "rung") ? "rungs" : "networks" };
  }

  /** A click with Ctrl takes one more, or that one out. */
  function toggle(cursor: Cursor, to: Cursor): void {
    const before: Chosen = chosen ?? { parts: [cursor.rung], places: cursor.place.length > 0 ? [cursor.place] : [] };
    const places = before.places.length > 0 && before.parts[0] === to.rung ? before.places : [];
    if (to.place.length === 0) {
      const parts = before.places.length > 0 ? [] : before.parts;
      choose(parts.includes(to.rung) ? parts.filter((each) => each !== to.rung) : [...parts, to.rung], [], to);
    } else {
      const left = places.filter((each) => !sameElement(each, to.place));
      const now = left.length < places.length ? left : [...places, to.place];
      choose(now.length > 0 ? [to.rung] : [], now, to);
    }
    go(to);
  }

  /** The parts that are chosen as a whole: charts are no networks. */
  const wholes = () =>
    (chosen?.parts ?? []).flatMap((index) => drawn[index] ?? []).filter(({ kind }) => kind !== "chart");

  function copy(): string | null {
    const part = chosen && drawn[chosen.parts[0] ?? -1];
    if (!chosen || !part) return null;
    if (chosen.places.length > 0) return textOf(part, chosen.places);
    return wholes()
      .sort((a, b) => a.found.from - b.found.from)
      .map(({ found }) => wholeText(found))
      .join("\n");
  }

  function remove(): void {
    const index = chosen?.parts[0] ?? 0;
    const part = drawn[index];
    if (!chosen || !part) return;
    if (chosen.places.length > 0) begin(index, without(part, chosen.places, around(part)));
    else {
      const gone = wholes();
      removeParts(
        path,
        gone.map(({ found }) => found),
      );
      go({ rung: Math.max(0, Math.min(...chosen.parts, drawn.length - gone.length - 1)), place: [] });
    }
    clear();
  }

  /** What a key does with all that is chosen; false where nothing is chosen, or the key means one element alone. */
  function press(key: string): boolean {
    const index = chosen?.parts[0] ?? 0;
    const part = drawn[index];
    if (!chosen || !part || readOnly) return false;
    const lower = key.toLowerCase();
    if (lower === "delete" || lower === "backspace" || lower === "ctrl+delete") remove();
    else if (lower === "ctrl+d" && chosen.places.length === 0) {
      const last = drawn[Math.max(...chosen.parts)];
      const networks = networksOf(copy() ?? "");
      if (last && networks) putParts(path, last.found, networks);
    } else if (lower === "ctrl+/" && chosen.places.length === 0)
      switchParts(
        path,
        wholes().map(({ found }) => found),
      );
    else if (lower === "b" && chosen.places.length > 0) begin(index, branched(part, chosen.places));
    else return false;
    clear();
    return true;
  }

  function cut(): string | null {
    const text = readOnly ? null : copy();
    if (text !== null) remove();
    return text;
  }

  return { chosen, holds, severalAt, clear, extend, byKey, toggle, press, copy, cut };
}
