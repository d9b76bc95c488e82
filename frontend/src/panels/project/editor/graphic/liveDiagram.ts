/** Values of a function block diagram, written to its wires and texts directly. */

import type { DiagramItem } from "../../../../logic/graphic/diagram";
import type { DiagramDrawing } from "../../../../logic/graphic/diagramLayout";
import { boolWires, variablesIn, wireValues } from "../../../../logic/graphic/diagramValues";
import { type PartFlow, type Seen, valueIn } from "../../../../logic/graphic/flow";
import type { Pou } from "../../../../wire/types";
import { type Shown, showWith } from "./follow";

/** The value of each wire whose line ran, as the code saw it; null where the line did not run. */
function seenWires(drawing: DiagramDrawing, { at, wires }: PartFlow): Map<string, string | null> {
  const found = new Map<string, string | null>();
  for (const { element, place } of drawing.elements) {
    const seen = at.get(place.join("."));
    for (const { wire } of element.item.outputs) if (wire) found.set(wire, seen ? (wires.get(wire) ?? null) : null);
  }
  return found;
}

/** Whether the box of a line was called: not where its EN was FALSE. */
const called = (item: DiagramItem, seen: Seen | undefined) =>
  seen !== undefined && !(item.inputs.some(({ name }) => name.toUpperCase() === "EN") && seen.power === false);

/** Shows values until it is stopped: as the code saw them, else what values tell. */
export function showDiagram(svg: SVGSVGElement, drawing: DiagramDrawing, pou: Pou): Shown {
  const { elements } = drawing;
  const items = elements.map(({ element }) => element.item);
  const bools = boolWires(items);
  const all = <T extends Element>(what: string) => [...svg.querySelectorAll<T & (SVGElement | HTMLElement)>(what)];
  const [wires, pins] = [all("[data-wire]"), all("[data-pin]")];
  const [texts, labels] = [all("[data-value]"), all("[data-wirevalue]")];
  const groups = all("[data-element]");
  const write = (place: Element, text: string) => {
    if (place.textContent !== text) place.textContent = text;
  };
  /** What the line of a pin saw; undefined where nothing was noted. */
  const seenAt = (place: Element, flow: PartFlow) => {
    const key = place.closest<SVGElement>("[data-element]")?.dataset.element;
    return key === undefined ? undefined : flow.at.get(key);
  };
  return showWith(pou, variablesIn(items), ({ text, forced }, noted) => {
    const values = noted ? seenWires(drawing, noted) : wireValues(items, text);
    const shownAt = (place: Element, variable: string) =>
      noted ? valueIn(seenAt(place, noted), variable) : text(variable);
    for (const wire of wires) {
      const key = wire.dataset.wire ?? "";
      const value = values.get(key) ?? null;
      wire.classList.toggle("on", value === "TRUE");
      wire.classList.toggle("unsure", !noted && value === null && bools.has(key));
    }
    for (const pin of pins) pin.classList.toggle("on", shownAt(pin, pin.dataset.pin ?? "") === "TRUE");
    for (const place of texts) {
      const variable = place.dataset.value ?? "";
      const value = shownAt(place, variable);
      write(place, value === null ? "" : ` ${value}`);
      place.closest("g")?.classList.toggle("forced", forced(variable));
    }
    for (const place of labels) write(place, values.get(place.dataset.wirevalue ?? "") ?? "");
    elements.forEach(({ element, place }, index) => {
      const seen = noted?.at.get(place.join("."));
      groups[index]?.classList.toggle("stale", seen?.stale === true);
      groups[index]?.classList.toggle("idle", noted !== null && !called(element.item, seen));
    });
  });
}
