/** What is active in a chart, written to its elements directly. */

import type { ChartTransition } from "../../../../logic/graphic/chart";
import type { ChartDrawing } from "../../../../logic/graphic/chartLayout";
import { type Condition, conditionOf, holdsBy, truthBy, variablesOf } from "../../../../logic/graphic/condition";
import { type Seen, valueIn } from "../../../../logic/graphic/flow";
import { type Drawing, layOut } from "../../../../logic/graphic/ladderLayout";
import { type Power, powerOf } from "../../../../logic/graphic/power";
import type { Pou } from "../../../../wire/types";
import { type Shown, showWith, type Values } from "./follow";

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

/** Shows steps, conditions and actions until it is stopped: as the code saw them, else what values tell. */
export function showChart(svg: SVGSVGElement, { elements }: ChartDrawing, pou: Pou): Shown {
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
  return showWith(pou, variables, (values, flow) => {
    elements.forEach(({ element, place }, index) => {
      const group = groups[index];
      if (!group) return;
      const seen = flow?.at.get(place.join("."));
      group.classList.toggle("stale", seen?.stale === true);
      if (element.kind === "step") paintStep(group, element.name, values, flow ? (seen ?? null) : undefined);
      else if (element.kind === "transition") {
        if (flow && element.rung === null) paintSeen(group, seen, tests.get(element));
        else paintTransition(group, element, tests.get(element), values);
      } else paintAction(group, element.action, values);
    });
  });
}

function write(group: SVGElement, what: string, text: string): void {
  const place = group.querySelector(`[data-live="${what}"]`);
  if (place && place.textContent !== text) place.textContent = text;
}

/** `seen`: what was noted at a step that was active in the scan; null where it was not, undefined where only values tell. */
function paintStep(group: SVGElement, name: string, { truth, text }: Values, seen: Seen | null | undefined): void {
  const active = seen ? true : seen === null ? false : truth(`${name}.X`) === true;
  group.classList.toggle("on", active);
  write(group, "time", active ? ((seen ? valueIn(seen, `${name}.T`) : null) ?? text(`${name}.T`) ?? "") : "");
}

/** A transition that was tested has its result, with the values that it was tested with; the others were not tested. */
function paintSeen(group: SVGElement, seen: Seen | undefined, test: Test | undefined): void {
  group.classList.toggle("on", seen?.power === true);
  group.classList.toggle("unsure", seen !== undefined && seen.power === null);
  group.classList.toggle("enabled", seen !== undefined);
  write(group, "values", seen ? (test?.shown ?? []).map((each) => valueIn(seen, each) ?? "").join("  ") : "");
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
