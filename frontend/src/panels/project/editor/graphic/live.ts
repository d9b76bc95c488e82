/** Values and power of a rung, written to its elements directly. */

import { type Condition, conditionOf, holdsBy, variablesOf } from "../../../../logic/graphic/condition";
import type { Drawing } from "../../../../logic/graphic/ladderLayout";
import { closedBy, type Power, powerOf } from "../../../../logic/graphic/power";
import type { Pou } from "../../../../wire/types";
import { follow, type Values } from "./follow";

/** The variables whose values a rung shows. */
function variablesIn({ nodes, elements }: Drawing): Set<string> {
  const named = new Set<string>();
  for (const node of nodes) {
    if (node.kind === "contact") for (const { name } of variablesOf(conditionOf(node.contact.operand))) named.add(name);
    if (node.kind === "box" && node.box.output !== null) named.add(`${node.box.callee}.${node.box.output}`);
  }
  for (const { element } of elements) if (element.kind === "coil") named.add(element.operand);
  return named;
}

/** Shows values and power in a drawing from now on, until the returned function is called. */
export function showRung(svg: SVGSVGElement, drawing: Drawing, pou: Pou): () => void {
  const parsed = new Map<string, Condition | null>();
  const conditionAt = (operand: string) => {
    const known = parsed.get(operand);
    if (known !== undefined) return known;
    const made = conditionOf(operand);
    parsed.set(operand, made);
    return made;
  };
  return follow(pou, variablesIn(drawing), ({ text, forced }) =>
    paintPower(svg, drawing, (operand) => holdsBy(conditionAt(operand), text), forced),
  );
}

function paintPower(
  svg: SVGSVGElement,
  { nodes, sends, elements }: Drawing,
  truth: (operand: string) => Power,
  forced: Values["forced"],
): void {
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
