/**
 * What is dragged in a drawing: an output to an input, a line of a network to a different place in the order, elements of a rung, of
 * a chart, and whole rungs and networks by their numbers.
 */

import { type PointerEvent, useRef, useState } from "react";
import { droppedInChart } from "../../../../logic/graphic/chartMove";
import { reordered } from "../../../../logic/graphic/diagramEdit";
import { connected } from "../../../../logic/graphic/diagramKeys";
import { type Drop, dropsOf, nearestDrop } from "../../../../logic/graphic/drops";
import type { Around, Made } from "../../../../logic/graphic/edit";
import type { Place } from "../../../../logic/graphic/ladderLayout";
import { moved } from "../../../../logic/graphic/select";
import type { DrawnPart } from "../../../../logic/graphic/sheet";
import { type Cursor, sameElement } from "./cursor";
import type { Chosen } from "./useChosen";
import { movePart, writeParts } from "./write";

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
  /** The rung or network as a whole is dragged. */
  whole: boolean;
}

/** What is under way, as it is drawn. */
interface Dragged {
  /** Where elements of a rung would be dropped; null where nothing is near. */
  over: { rung: number; drop: Drop } | null;
  /** The element of a network or chart that a drop means, joined by points. */
  element: { rung: number; key: string } | null;
  /** Where a whole part would come. */
  edge: { rung: number; above: boolean } | null;
}

const NOWHERE: Dragged = { over: null, element: null, edge: null };

const FAR_ENOUGH = 5;

export function useDrag({ path, drawn, readOnly, chosen, go, begin, around }: Dragging) {
  const from = useRef<From | null>(null);
  const [dragged, setDragged] = useState<Dragged | null>(null);

  function onPointerDown({ target, button, clientX, clientY }: PointerEvent): void {
    from.current = null;
    if (button !== 0 || readOnly) return;
    const rung = indexOf(target);
    const kind = drawn[rung]?.kind;
    const whole = target instanceof Element && target.closest(".no") !== null && kind !== "chart";
    const wanted = kind === "network" ? ".el.item, [data-side='output']" : ".el:not(.gap)";
    const place = whole ? [] : placeOf(target, wanted);
    if (place) from.current = { rung, place, x: clientX, y: clientY, whole };
  }

  function onPointerMove({ target, clientX, clientY, buttons }: PointerEvent): void {
    const begun = from.current;
    const kind = begun && drawn[begun.rung]?.kind;
    if (!begun) return;
    if (buttons === 0) leave();
    else if (!dragged && Math.hypot(clientX - begun.x, clientY - begun.y) < FAR_ENOUGH) return;
    else if (begun.whole) setDragged({ ...NOWHERE, edge: edgeAt(target, clientY) });
    else if (kind === "rung") setDragged({ ...NOWHERE, over: dropAt(target, clientX, clientY) });
    else {
      const key = indexOf(target) === begun.rung ? placeOf(target, ".el")?.join(".") : undefined;
      const now = key === undefined || key === begun.place.join(".") ? null : { rung: begun.rung, key };
      if (!dragged || dragged.element?.key !== now?.key) setDragged({ ...NOWHERE, element: now });
    }
  }

  /** Above or below the part under the pointer. */
  function edgeAt(target: EventTarget, y: number): Dragged["edge"] {
    const rung = indexOf(target);
    const row = target instanceof Element ? target.closest("[data-index]") : null;
    if (!row || !drawn[rung] || drawn[rung]?.kind === "chart") return null;
    const { top, height } = row.getBoundingClientRect();
    return { rung, above: y < top + height / 2 };
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
    const { over, edge } = dragged ?? NOWHERE;
    const moving = dragged !== null;
    leave();
    const part = begun && drawn[begun.rung];
    if (!begun || !part) return;
    if (begun.whole) {
      if (!edge || !moving || edge.rung === begun.rung) return;
      go({ rung: movePart(path, drawn, begun.rung, edge), place: [] });
    } else if (part.kind !== "rung") {
      const there = indexOf(target) === begun.rung ? endOn(part, begun.place, target) : null;
      if (!there || !begin(begun.rung, there)) return;
    } else if (!moving) return;
    else if (over) drop(begun, over);
    // The click that ends the drag means nothing. There is none where the element is not there any more.
    const ignore = (event: Event) => event.stopPropagation();
    window.addEventListener("click", ignore, { capture: true, once: true });
    setTimeout(() => window.removeEventListener("click", ignore, true));
  }

  /** What it means to end a drag of an element of a network or chart there. */
  function endOn(part: DrawnPart, place: Place, target: EventTarget): Made {
    const { text } = part.found;
    if (part.kind === "chart") {
      const goal = placeOf(target, ".el");
      return goal && droppedInChart(part.found, place, goal);
    }
    const input = placeOf(target, "[data-side='input']");
    if (input) return connected(text, place, input, around());
    const [goal] = placeOf(target, ".el.item") ?? [];
    const [index = 0] = place;
    if (goal === undefined || goal === index || place.length > 1) return null;
    return { text: reordered(text, index, goal), place: [goal], naming: null };
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

  /** Where what is dragged would come in a rung; null where nothing is dragged that fits in rungs. */
  function dropIn(rung: number): Drop | "elsewhere" | null {
    if (!dragged || dragged.edge || dragged.element || drawn[from.current?.rung ?? -1]?.kind !== "rung") return null;
    if (from.current?.whole) return null;
    return dragged.over?.rung === rung ? dragged.over.drop : "elsewhere";
  }

  /** What of a part a drop means: an element by its place, or `above` or `below` it. Empty where it means nothing there. */
  function targetIn(rung: number): string {
    if (dragged?.edge?.rung === rung) return dragged.edge.above ? "above" : "below";
    return dragged?.element?.rung === rung ? dragged.element.key : "";
  }

  return { dropIn, targetIn, onPointerDown, onPointerMove, onPointerUp, onPointerLeave: leave };
}

const indexOf = (target: EventTarget) =>
  Number((target instanceof Element ? target.closest<HTMLElement>("[data-index]")?.dataset.index : undefined) ?? -1);

function placeOf(target: EventTarget, wanted: string): Place | null {
  const found = target instanceof Element ? target.closest<SVGElement>(wanted)?.dataset.element : undefined;
  return found ? found.split(".").map(Number) : null;
}
