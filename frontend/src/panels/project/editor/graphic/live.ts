/** Values and power of a rung, written to its elements directly. */

import type { Drawing } from "../../../../logic/graphic/ladderLayout";
import { closedBy, powerOf } from "../../../../logic/graphic/power";
import type { Pou } from "../../../../wire/types";
import { follow, type Values } from "./follow";

/** The operands whose values a rung shows. */
function operandsOf({ nodes, elements }: Drawing): Set<string> {
  const named = new Set<string>();
  for (const node of nodes) {
    if (node.kind === "contact") named.add(node.contact.operand);
    if (node.kind === "box" && node.box.output !== null) named.add(`${node.box.callee}.${node.box.output}`);
  }
  for (const { element } of elements) if (element.kind === "coil") named.add(element.operand);
  return named;
}

/** Shows values and power in a drawing from now on, until the returned function is called. */
export const showRung = (svg: SVGSVGElement, drawing: Drawing, pou: Pou): (() => void) =>
  follow(pou, operandsOf(drawing), (values) => paintPower(svg, drawing, values));

function paintPower(svg: SVGSVGElement, { nodes, sends, elements }: Drawing, { truth, forced }: Values): void {
  const power = powerOf(nodes, sends, truth);
  const has = (node: number) => power[node] === true;
  for (const wire of svg.querySelectorAll<SVGElement>("[data-node]")) {
    const node = Number(wire.dataset.node);
    wire.classList.toggle("on", has(node));
    wire.classList.toggle("unsure", power[node] === null);
  }
  const groups = svg.querySelectorAll<SVGElement>("[data-element]");
  elements.forEach(({ element, after }, index) => {
    const group = groups[index];
    if (!group || (element.kind !== "contact" && element.kind !== "coil")) return;
    const value = truth(element.operand);
    const closed = element.kind === "contact" ? closedBy(element, truth) : value;
    group.classList.toggle("closes", closed === true);
    group.classList.toggle("on", closed === true && (element.kind === "coil" || has(after)));
    group.classList.toggle("forced", forced(element.operand));
  });
}
