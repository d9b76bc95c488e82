/** What is dragged in a drawing: an output to an input, or elements of a rung to a different place. */

import { type PointerEvent, useRef, useState } from "react";
import { connected } from "../../../../logic/graphic/diagramKeys";
import { type Drop, dropsOf, nearestDrop } from "../../../../logic/graphic/drops";
import type { Around, Made } from "../../../../logic/graphic/edit";
import type { Place } from "../../../../logic/graphic/ladderLayout";
import { moved } from "../../../../logic/graphic/select";
import type { DrawnPart } from "../../../../logic/graphic/sheet";
import { sameElement } from "./cursor";
import type { Chosen } from "./useChosen";
import type { Cursor } from "./useEditing";
import { writeParts } from "./write";

interface Dragging {
  path: string;
  drawn: readonly DrawnPart[];
  readOnly: boolean;
  chosen: Chosen | null;
  go: (to: Cursor) => void;
  begin: (at: number, made: Made) => boolean;
  around: () => Around;
}

interface From extends Cursor {
  x: number;
  y: number;
}

/** What is under way, as it is drawn. */
interface Dragged {
  /** Where elements would be dropped; null where nothing is near. */
  over: { rung: number; drop: Drop } | null;
}

const FAR_ENOUGH = 5;

export function useDrag({ path, drawn, readOnly, chosen, go, begin, around }: Dragging) {
  const from = useRef<From | null>(null);
  const [dragged, setDragged] = useState<Dragged | null>(null);

  function onPointerDown({ target, button, clientX, clientY }: PointerEvent): void {
    from.current = null;
    if (button !== 0 || readOnly) return;
    const rung = indexOf(target);
    const wanted = drawn[rung]?.kind === "network" ? ".el.item, [data-side='output']" : ".el:not(.gap)";
    const place = placeOf(target, wanted);
    if (place && drawn[rung]?.kind !== "chart") from.current = { rung, place, x: clientX, y: clientY };
  }

  function onPointerMove({ target, clientX, clientY, buttons }: PointerEvent): void {
    const begun = from.current;
    if (!begun || drawn[begun.rung]?.kind !== "rung") return;
    if (buttons === 0) leave();
    else if (!dragged && Math.hypot(clientX - begun.x, clientY - begun.y) < FAR_ENOUGH) return;
    else setDragged({ over: dropAt(target, clientX, clientY) });
  }

  function dropAt(target: EventTarget, x: number, y: number): Dragged["over"] {
    const rung = indexOf(target);
    const part = drawn[rung];
    const row = target instanceof Element ? target.closest("[data-index]") : null;
    const svg = row?.querySelector("svg.draw");
    if (part?.kind !== "rung" || !part.drawing || !part.readable || !svg) return null;
    const { left, top, width } = svg.getBoundingClientRect();
    const scale = width / part.drawing.width;
    const drop = nearestDrop(dropsOf(part.drawing), (x - left) / scale, (y - top) / scale);
    return drop && { rung, drop };
  }

  function onPointerUp({ target }: PointerEvent): void {
    const begun = from.current;
    const over = dragged?.over;
    const moving = dragged !== null;
    leave();
    const part = begun && drawn[begun.rung];
    if (!begun || !part) return;
    if (part.kind === "network") {
      const place = placeOf(target, "[data-side='input']");
      if (!place || indexOf(target) !== begun.rung) return;
      begin(begun.rung, connected(part.found.text, begun.place, place, around()));
    } else if (!moving) return;
    else if (over) drop(begun, over);
    // The click that ends the drag means nothing. There is none where the element is not there any more.
    const ignore = (event: Event) => event.stopPropagation();
    window.addEventListener("click", ignore, { capture: true, once: true });
    setTimeout(() => window.removeEventListener("click", ignore, true));
  }

  function drop(begun: From, { rung, drop }: NonNullable<Dragged["over"]>): void {
    const [source, target] = [drawn[begun.rung], drawn[rung]];
    if (source?.kind !== "rung" || target?.kind !== "rung") return;
    const all = chosen?.parts[0] === begun.rung ? chosen.places : [];
    const places = all.some((each) => sameElement(each, begun.place)) ? all : [begun.place];
    const made = moved(source, places, target, drop.place);
    if ("refused" in made || made.source === null) {
      begin(rung, "refused" in made ? made : made.target);
      return;
    }
    writeParts(path, [
      { found: source.found, text: made.source.text },
      { found: target.found, text: made.target.text },
    ]);
    go({ rung, place: made.target.place });
  }

  function leave(): void {
    from.current = null;
    setDragged(null);
  }

  return { dragged, onPointerDown, onPointerMove, onPointerUp, onPointerLeave: leave };
}

const indexOf = (target: EventTarget) =>
  Number((target instanceof Element ? target.closest<HTMLElement>("[data-index]")?.dataset.index : undefined) ?? -1);

function placeOf(target: EventTarget, wanted: string): Place | null {
  const found = target instanceof Element ? target.closest<SVGElement>(wanted)?.dataset.element : undefined;
  return found ? found.split(".").map(Number) : null;
}
