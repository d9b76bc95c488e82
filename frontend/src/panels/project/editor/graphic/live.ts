/** Values and power of a rung, written to its elements directly. */

import { type Condition, conditionOf, holdsBy, variablesOf } from "../../../../logic/graphic/condition";
import { type PartFlow, seenPower, valueIn } from "../../../../logic/graphic/flow";
import type { Drawing } from "../../../../logic/graphic/ladderLayout";
import { isVariable } from "../../../../logic/graphic/measure";
import { closedBy, type Power, powerOf } from "../../../../logic/graphic/power";
import { seenAsNow } from "../../../../store/debug/seenAs";
import { t } from "../../../../text";
import type { Pou } from "../../../../wire/types";
import { clear, type Shown, showWith, type Values } from "./follow";
import { isStill } from "./followFlow";

/** The variables whose values a rung shows. */
function variablesIn({ nodes, elements }: Drawing): Set<string> {
  const named = new Set<string>();
  for (const node of nodes) {
    if (node.kind === "contact") for (const { name } of variablesOf(conditionOf(node.contact.operand))) named.add(name);
    if (node.kind === "box" && node.box.output !== null) named.add(`${node.box.callee}.${node.box.output}`);
  }
  for (const { element, frame } of elements) {
    if (element.kind === "coil") named.add(element.operand);
    if (!frame) continue;
    for (const { text } of [...frame.inputs, ...frame.outputs]) if (isVariable(text)) named.add(text);
    if (frame.progress !== "") named.add(frame.progress);
  }
  return named;
}

/** Shows values and power in a drawing from now on, until the returned function is called: as the code saw them, else what values tell. */
export function showRung(svg: SVGSVGElement, drawing: Drawing, pou: Pou): Shown {
  const parsed = new Map<string, Condition | null>();
  const conditionAt = (operand: string) => {
    const known = parsed.get(operand);
    if (known !== undefined) return known;
    const made = conditionOf(operand);
    parsed.set(operand, made);
    return made;
  };
  return showWith(pou, variablesIn(drawing), (values, flow) => {
    const { text, forced } = values;
    if (flow) paintSeen(svg, drawing, flow, conditionAt, values);
    // Without an instance nothing has a value, and no rail has power.
    else if (seenAsNow(pou.name) === undefined) clear(svg);
    else paintPower(svg, drawing, (operand) => holdsBy(conditionAt(operand), text), forced);
    if (flow || seenAsNow(pou.name) !== undefined) paintValues(svg, text, flow);
  });
}

/** Values beside the pins of boxes, and how far timers and counters are. */
function paintValues(svg: SVGSVGElement, text: Values["text"], flow: PartFlow | null): void {
  for (const place of svg.querySelectorAll<SVGElement>("[data-value]")) {
    const variable = place.dataset.value ?? "";
    const key = place.closest<SVGElement>("[data-element]")?.dataset.element;
    const seen = key === undefined ? undefined : flow?.at.get(key);
    const value = valueIn(seen, variable) ?? text(variable);
    const name = place.dataset.named === undefined ? "" : variable.slice(variable.lastIndexOf(".") + 1);
    const shown = value === null ? "" : `${name} ${value}`;
    if (place.textContent !== shown) place.textContent = shown;
  }
}

function paintSeen(
  svg: SVGSVGElement,
  drawing: Drawing,
  flow: PartFlow,
  conditionAt: (operand: string) => Condition | null,
  { text, forced }: Values,
): void {
  const power = seenPower(drawing, flow);
  const still = isStill();
  for (const wire of svg.querySelectorAll<SVGElement>("[data-node]")) {
    const found = power[Number(wire.dataset.node)];
    wire.classList.toggle("on", found?.power === true);
    wire.classList.toggle("unsure", found?.power === null);
    wire.classList.toggle("stale", found?.stale === true);
  }
  const groups = svg.querySelectorAll<SVGElement>("[data-element]");
  drawing.elements.forEach(({ element, place, before, after }, index) => {
    const group = groups[index];
    if (!group) return;
    const seen = flow.at.get(place.join("."));
    group.classList.toggle("stale", seen?.stale === true);
    if (element.kind !== "contact" && element.kind !== "coil") return;
    const read = (name: string) => valueIn(seen, name);
    const value = seen ? holdsBy(conditionAt(element.operand), read) : null;
    const through = power[after]?.power === true;
    const closed =
      element.kind === "coil"
        ? value === true
        : power[before]?.power === true
          ? through
          : closedBy(element, () => value) === true;
    group.classList.toggle("closes", closed);
    group.classList.toggle("on", closed && (element.kind === "coil" || through));
    group.classList.toggle("forced", forced(element.operand));
    const [then, now] = [read(element.operand), text(element.operand)];
    const apart = still && then !== null && now !== null && then !== now;
    const note = group.querySelector("[data-seen]");
    if (note) note.textContent = apart ? t("graphic.flow.now", { value: now }) : "";
  });
}

function paintPower(
  svg: SVGSVGElement,
  { nodes, sends, elements }: Drawing,
  truth: (operand: string) => Power,
  forced: Values["forced"],
): void {
  const power = powerOf(nodes, sends, truth);
  for (const each of svg.querySelectorAll(".stale")) each.classList.remove("stale");
  for (const each of svg.querySelectorAll("[data-seen]")) each.textContent = "";
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
