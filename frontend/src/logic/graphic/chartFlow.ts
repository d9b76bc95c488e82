/** How the steps of a chart follow each other: which transitions go back, and how many paths meet where. */

import { type Chart, type ChartStep, type ChartTransition, keyOf } from "./chart";

/** What is drawn where paths meet: a step that several transitions lead to, or a transition that waits for several steps. */
type Meeting = { kind: "step"; step: ChartStep } | { kind: "transition"; transition: ChartTransition };

export interface Flow {
  steps: ReadonlyMap<string, ChartStep>;
  /** The transitions after each step, by its key, in the order of the text. */
  after: ReadonlyMap<string, readonly ChartTransition[]>;
  meetings: ReadonlyMap<string, Meeting>;
  /** How many paths come to a meeting from above. */
  paths: Map<string, number>;
}

export const meetingOf = (transition: ChartTransition) => `T${transition.span.at}`;

export function flowOf({ steps, transitions }: Chart): Flow {
  const byKey = new Map(steps.map((step) => [keyOf(step.name), step]));
  const after = new Map<string, ChartTransition[]>();
  const meetings = new Map<string, Meeting>(steps.map((step) => [keyOf(step.name), { kind: "step", step }]));
  const paths = new Map<string, number>();
  for (const transition of transitions) {
    if (transition.from.length > 1) meetings.set(meetingOf(transition), { kind: "transition", transition });
    for (const from of transition.from.map(keyOf)) after.set(from, [...(after.get(from) ?? []), transition]);
  }
  walk(steps, after, paths);
  return { steps: byKey, after, meetings, paths };
}

/** Counts the paths to each meeting that do not go back to a step above. */
function walk(
  steps: readonly ChartStep[],
  after: ReadonlyMap<string, readonly ChartTransition[]>,
  paths: Map<string, number>,
): void {
  const above = new Set<string>();
  const seen = new Set<string>();
  const come = (key: string, next: () => void) => {
    if (above.has(key)) return;
    paths.set(key, (paths.get(key) ?? 0) + 1);
    if (seen.has(key)) return;
    enter(key, next);
  };
  const enter = (key: string, next: () => void) => {
    seen.add(key);
    above.add(key);
    next();
    above.delete(key);
  };
  const targets = ({ to }: ChartTransition) => {
    for (const each of to.map(keyOf)) come(each, () => leave(each));
  };
  const leave = (key: string) => {
    for (const each of after.get(key) ?? [])
      if (each.from.length === 1) targets(each);
      else come(meetingOf(each), () => targets(each));
  };
  for (const step of inDrawingOrder(steps)) {
    const key = keyOf(step.name);
    if (!seen.has(key)) enter(key, () => leave(key));
  }
}

/** The steps at which a drawing may begin: the initial ones, then those that nothing else leads to. */
export const inDrawingOrder = (steps: readonly ChartStep[]): ChartStep[] => [
  ...steps.filter(({ initial }) => initial),
  ...steps.filter(({ initial }) => !initial),
];
