/** Values of a function block diagram, written to its wires and texts directly. */

import type { DiagramDrawing } from "../../../../logic/graphic/diagramLayout";
import { boolWires, variablesIn, wireValues } from "../../../../logic/graphic/diagramValues";
import type { Pou } from "../../../../wire/types";
import { follow } from "./follow";

/** Shows values from now on, until the returned function is called. */
export function showDiagram(svg: SVGSVGElement, { elements }: DiagramDrawing, pou: Pou): () => void {
  const items = elements.map(({ element }) => element.item);
  const bools = boolWires(items);
  const all = <T extends Element>(what: string) => [...svg.querySelectorAll<T & (SVGElement | HTMLElement)>(what)];
  const [wires, pins] = [all("[data-wire]"), all("[data-pin]")];
  const [texts, labels] = [all("[data-value]"), all("[data-wirevalue]")];
  const write = (place: Element, text: string) => {
    if (place.textContent !== text) place.textContent = text;
  };
  return follow(pou, variablesIn(items), ({ text, truth, forced }) => {
    const values = wireValues(items, text);
    for (const wire of wires) {
      const key = wire.dataset.wire ?? "";
      const value = values.get(key) ?? null;
      wire.classList.toggle("on", value === "TRUE");
      wire.classList.toggle("unsure", value === null && bools.has(key));
    }
    for (const pin of pins) pin.classList.toggle("on", truth(pin.dataset.pin ?? "") === true);
    for (const place of texts) {
      const variable = place.dataset.value ?? "";
      const value = text(variable);
      write(place, value === null ? "" : ` ${value}`);
      place.closest("g")?.classList.toggle("forced", forced(variable));
    }
    for (const place of labels) write(place, values.get(place.dataset.wirevalue ?? "") ?? "");
  });
}
