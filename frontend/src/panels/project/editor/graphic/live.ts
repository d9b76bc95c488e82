/** Values of a rung, written to its elements directly: twenty times a second React would draw it again. */

import type { Drawing } from "../../../../logic/graphic/ladderLayout";
import { closedBy, type Power, powerOf } from "../../../../logic/graphic/power";
import { pathOf } from "../../../../store/debug/seenAs";
import { bindCell } from "../../../../store/plc/values";
import { watch } from "../../../../store/plc/watches";
import { forcedAt } from "../../../../store/watch/forces";
import type { Pou } from "../../../../wire/types";

/** A variable as it may be written: `s[2].ready`. An expression is none. */
const VARIABLE = /^[\p{L}_%][\p{L}\p{N}_.]*(?:\[[\p{N}\s,-]+\][\p{L}\p{N}_.]*)*$/u;

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
export function showLive(svg: SVGSVGElement, drawing: Drawing, pou: Pou): () => void {
  const paths = new Map<string, string>();
  for (const operand of operandsOf(drawing)) {
    const path = VARIABLE.test(operand) ? pathOf(pou, operand) : undefined;
    if (path !== undefined) paths.set(operand, path);
  }
  const values = new Map<string, boolean>();
  let due = 0;
  const paint = () => {
    due = 0;
    paintPower(svg, drawing, paths, (operand) => values.get(operand) ?? null);
  };
  const unwatch = watch([...paths.values()]);
  const unbind = [...paths].map(([operand, path]) =>
    bindCell(path, "default", ({ text }) => {
      if (text === "TRUE" || text === "FALSE") values.set(operand, text === "TRUE");
      else values.delete(operand);
      due ||= requestAnimationFrame(paint);
    }),
  );
  paint();
  return () => {
    cancelAnimationFrame(due);
    for (const each of unbind) each();
    unwatch();
  };
}

function paintPower(
  svg: SVGSVGElement,
  { nodes, sends, elements }: Drawing,
  paths: ReadonlyMap<string, string>,
  read: (operand: string) => Power,
): void {
  const power = powerOf(nodes, sends, read);
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
    const value = read(element.operand);
    const closed = element.kind === "contact" ? closedBy(element, read) : value;
    group.classList.toggle("closes", closed === true);
    group.classList.toggle("on", closed === true && (element.kind === "coil" || has(after)));
    const path = paths.get(element.operand);
    group.classList.toggle("forced", path !== undefined && forcedAt(path) !== undefined);
  });
}
