/** What is active in a chart, written to its elements directly. */

import type { ChartTransition } from "../../../../logic/graphic/chart";
import type { ChartDrawing } from "../../../../logic/graphic/chartLayout";
import { type Condition, conditionOf, holdsBy, truthBy, variablesOf } from "../../../../logic/graphic/condition";
import { type Drawing, layOut } from "../../../../logic/graphic/ladderLayout";
import { type Power, powerOf } from "../../../../logic/graphic/power";
import type { Pou } from "../../../../wire/types";
import { follow, type Values } from "./follow";

interface Test {
  variables: readonly string[];
  /** Those whose values are shown beside the condition. */
  shown: readonly string[];
  holds: (values: Values) => Power;
}

function testOf({ condition, rung }: ChartTransition): Test {
  if (rung !== null) return rungTest(layOut(rung, 0));
  const parsed: Condition | null = conditionOf(condition);
  const all = variablesOf(parsed);
  return {
    variables: all.map(({ name }) => name),
    shown: all.filter(({ compared }) => compared).map(({ name }) => name),
    holds: ({ text }) => holdsBy(parsed, text),
  };
}

function rungTest({ nodes, sends, end }: Drawing): Test {
  const variables = nodes.flatMap((node) =>
    node.kind === "contact" ? variablesOf(conditionOf(node.contact.operand)).map(({ name }) => name) : [],
  );
  const holds = ({ text }: Values) => powerOf(nodes, sends, (operand) => truthBy(operand, text))[end] ?? null;
  return { variables, shown: [], holds };
}

/** Shows steps, conditions and actions from now on, until the returned function is called. */
export function showChart(svg: SVGSVGElement, { elements }: ChartDrawing, pou: Pou): () => void {
  const tests = new Map<ChartTransition, Test>();
  const variables = new Set<string>();
  for (const { element } of elements) {
    if (element.kind === "step") for (const each of ["X", "T"]) variables.add(`${element.name}.${each}`);
    if (element.kind === "action") variables.add(element.action);
    if (element.kind !== "transition") continue;
    const test = testOf(element);
    tests.set(element, test);
    for (const each of test.variables) variables.add(each);
  }
  const groups = svg.querySelectorAll<SVGElement>("[data-element]");
  return follow(pou, variables, (values) => {
    elements.forEach(({ element }, index) => {
      const group = groups[index];
      if (!group) return;
      if (element.kind === "step") paintStep(group, element.name, values);
      else if (element.kind === "transition") paintTransition(group, element, tests.get(element), values);
      else paintAction(group, element.action, values);
    });
  });
}

function write(group: SVGElement, what: string, text: string): void {
  const place = group.querySelector(`[data-live="${what}"]`);
  if (place && place.textContent !== text) place.textContent = text;
}

function paintStep(group: SVGElement, name: string, { truth, text }: Values): void {
  const active = truth(`${name}.X`) === true;
  group.classList.toggle("on", active);
  write(group, "time", active ? (text(`${name}.T`) ?? "") : "");
}

function paintTransition(group: SVGElement, { from }: ChartTransition, test: Test | undefined, values: Values): void {
  const holds = test?.holds(values) ?? null;
  group.classList.toggle("on", holds === true);
  group.classList.toggle("unsure", holds === null);
  group.classList.toggle(
    "enabled",
    from.every((step) => values.truth(`${step}.X`) === true),
  );
  write(group, "values", (test?.shown ?? []).map((each) => values.text(each) ?? "").join("  "));
}

function paintAction(group: SVGElement, action: string, { truth, forced }: Values): void {
  const value = truth(action);
  group.classList.toggle("known", value !== null);
  group.classList.toggle("closes", value === true);
  group.classList.toggle("forced", forced(action));
}
