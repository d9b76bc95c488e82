/** Parts of a chart in a different place: what is dragged to an element of it, and several steps that are put in. */

import type { Chart, ChartStep } from "./chart";
import {
  actionPut,
  blanksOf,
  chartOf,
  edited,
  elementsOf,
  has,
  instead,
  isStep,
  listed,
  relisted,
  same,
  stepOf,
  type Written,
  without,
} from "./chartKeys";
import { readChart } from "./charts";
import { NOTHING } from "./diagram";
import { type Around, type Change, changed, type Edit, type Made, newName, type Refused } from "./edit";
import type { Place } from "./ladderLayout";
import type { Found } from "./networks";
import { wordsIn } from "./reader";

const UNFIT: Refused = { refused: "graphic.refused.move" };

/** An action in a different step, a step after a different one, or a transition to a different step. Null where nothing changes. */
export function droppedInChart(found: Found, [from = -1]: Place, [to = -1]: Place): Made {
  const written = chartOf(found, found.text);
  if (!written) return { refused: "graphic.refused.unread" };
  const elements = elementsOf(written.chart);
  const [dragged, goal] = [elements[from], elements[to]];
  if (!dragged || !goal || dragged === goal) return null;
  const { text, chart } = written;
  if (dragged.kind === "action") {
    const step = stepOf(written, goal);
    if (!step || same(step.name, dragged.step)) return null;
    const put = actionPut(written, step)(text.slice(dragged.span.at, dragged.span.end));
    const made = changed(text, [without(text, dragged.span), put]);
    return edited(
      written,
      made,
      (each) => each.kind === "action" && same(each.step, step.name) && each.action === dragged.action,
    );
  }
  if (dragged.kind === "transition") {
    const step = stepOf(written, goal);
    if (!step) return null;
    const made = changed(text, [{ ...dragged.toAt, text: step.name }]);
    return edited(written, made, (each) => each.kind === "transition" && each.span.at === dragged.span.at);
  }
  const after = goal.kind === "transition" ? goal : onlyAfter(chart, stepOf(written, goal)?.name ?? "");
  if (!after || same(stepOf(written, goal)?.name ?? "", dragged.name)) return goal.kind === "transition" ? UNFIT : null;
  return stepAfter(written, dragged, after, goal.span.end);
}

/** The one transition after a step; undefined where there are several, or it waits for other steps, too. */
function onlyAfter({ transitions }: Chart, name: string) {
  const next = transitions.filter(({ from }) => has(from, name));
  return next.length === 1 && next[0]?.from.length === 1 ? next[0] : undefined;
}

/** A step between a transition and what that leads to. Its own transition keeps its condition, and so do the others. */
function stepAfter(written: Written, step: ChartStep, after: Chart["transitions"][number], end: number): Made {
  const { text, chart } = written;
  const { name } = step;
  if (has(after.from, name) || has(after.to, name)) return null;
  const next = onlyAfter(chart, name);
  const before = chart.transitions.filter(({ to }) => has(to, name));
  if (step.initial || !next || before.some(({ to }) => to.length > 1)) return UNFIT;
  const changes: Change[] = before.map(({ toAt }) => ({ ...toAt, text: listed(next.to) }));
  changes.push({ ...next.toAt, text: listed(after.to) }, { ...after.toAt, text: name });
  const block = `\n${blanksOf(written, step.span)}${text.slice(step.span.at, step.span.end)}`;
  changes.push(without(text, step.span), { at: end, end, text: block });
  return edited(written, changed(text, changes), isStep(name));
}

/** Several steps, and the transitions between them, after the element at the cursor; null where the text is no such thing. */
export function partsPut(found: Found, [index = 0]: Place, pasted: string, around: Around): Edit | null {
  const written = chartOf(found, found.text);
  const goal = written && elementsOf(written.chart)[index];
  const copied = namedAnew(pasted, around);
  const read = copied === null ? null : readChart({ ...found, text: copied, closed: true });
  if (!written || !goal || copied === null || read?.kind !== "chart" || read.steps.length < 2) return null;
  const names = read.steps.map(({ name }) => name);
  const known = [...names, ...written.chart.steps.map(({ name }) => name)];
  if (
    read.bodies.length > 0 ||
    read.transitions.some(({ from, to }) => [...from, ...to].some((each) => !has(known, each)))
  )
    return null;
  const lines = copied.split("\n").map((line) => line.trimEnd());
  names.slice(1).forEach((name, at) => {
    const reached = read.transitions.some(({ to }) => has(to, name));
    if (!reached) lines.push(transition(names[at] ?? "", name));
  });
  return joined(written, goal, names, read, lines);
}

const transition = (from: string, to: string) => `TRANSITION FROM ${from} TO ${to} := ${NOTHING}; END_TRANSITION`;

/** What leads on from the element at the cursor leads on from the last of the new steps. */
function joined(
  written: Written,
  goal: ReturnType<typeof elementsOf>[number],
  names: readonly string[],
  read: Chart,
  lines: readonly string[],
): Edit | null {
  const [first = "", last = ""] = [names[0], names.at(-1)];
  const open = !read.transitions.some(({ from }) => has(from, last));
  const step = stepOf(written, goal);
  const changes: Change[] = [];
  const more: string[] = [];
  if (step) {
    more.push(transition(step.name, first));
    for (const { from, fromAt } of written.chart.transitions)
      if (open && has(from, step.name)) changes.push(relisted(from, fromAt, instead(step.name, last)));
  } else if (goal.kind === "transition") {
    if (open) more.push(transition(last, listed(goal.to)));
    changes.push({ ...goal.toAt, text: first });
  }
  const { span } = step ?? goal;
  const blanks = blanksOf(written, span);
  const put = [...lines, ...more].map((line) => `\n${line === "" ? "" : blanks}${line}`).join("");
  return edited(
    written,
    changed(written.text, [...changes, { at: span.end, end: span.end, text: put }]),
    isStep(first),
  );
}

/** Steps with names that are taken get new ones, in all of the text; none of them is initial. Null where it is no chart. */
function namedAnew(text: string, { names }: Around): string | null {
  const found = { text, from: 0, to: text.length, body: { at: 0, end: text.length }, closed: true };
  const read = readChart({ ...found, kind: "chart", head: EMPTY, line: 1, indent: "" });
  if (read.kind !== "chart") return null;
  const taken = new Set(names);
  const anew = new Map<string, string>();
  for (const { name } of read.steps) {
    const wanted = taken.has(name.toUpperCase()) ? newName(name.replace(/\d+$/, ""), taken) : name;
    taken.add(wanted.toUpperCase());
    anew.set(name.toUpperCase(), wanted);
  }
  const changes = [...wordsIn(text)].flatMap(({ word, at }): Change[] => {
    const end = at + word.length;
    if (word === "INITIAL_STEP") return [{ at, end, text: "STEP" }];
    const wanted = /\.\s*$/.test(text.slice(0, at)) ? undefined : anew.get(word);
    return wanted === undefined ? [] : [{ at, end, text: wanted }];
  });
  return changed(text, changes);
}

const EMPTY = { label: "", title: "", comment: [], off: false };
