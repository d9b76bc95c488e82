/** What a key does to a sequential function chart at the cursor. */

import { type Chart, type ChartAction, type ChartStep, type ChartTransition, keyOf } from "./chart";
import { readChart } from "./charts";
import { NOTHING } from "./diagram";
import { blanksAt } from "./diagramEdit";
import {
  type Around,
  type Change,
  changed,
  type Edit,
  isName,
  isOnePiece,
  type Made,
  type Naming,
  newName,
  withDeclared,
} from "./edit";
import type { Place } from "./ladderLayout";
import { type Found, lineStartOf } from "./networks";
import { wordsIn } from "./reader";
import type { Span } from "./tree";

type ChartElement = ChartStep | ChartTransition | ChartAction;

/** A chart as it is edited. */
export interface Written {
  found: Found;
  text: string;
  chart: Chart;
}

export function chartOf(found: Found, text: string): Written | null {
  const chart = readChart({ ...found, text });
  return chart.kind === "chart" ? { found, text, chart } : null;
}

/** In the order of the text, as the places of a drawing count them. */
/** The order of places. */
export const elementsOf = ({ steps, transitions }: Chart): ChartElement[] =>
  [...steps, ...steps.flatMap(({ actions }) => actions), ...transitions].sort((a, b) => a.span.at - b.span.at);

/** The chart after a key; null where the key does nothing there. */
export function chartEdit(found: Found, key: string, [index]: Place, around: Around): Made {
  const deed = DEEDS[key.length === 1 ? key.toLowerCase() : key];
  if (!deed) return null;
  const written = chartOf(found, found.text);
  if (!written) return { refused: "graphic.refused.unread" };
  const element = index === undefined ? undefined : elementsOf(written.chart)[index];
  return element ? deed(written, element, around) : null;
}

/** The place of the first transition without a condition; null where there is none. */
export function emptyIn(found: Found, text: string): Place | null {
  const written = chartOf(found, text);
  const at = written
    ? elementsOf(written.chart).findIndex((each) => each.kind === "transition" && each.condition === NOTHING)
    : -1;
  return at < 0 ? null : [at];
}

type Deed = (written: Written, element: ChartElement, around: Around) => Made;

const DEEDS: Record<string, Deed> = {
  s: addStep,
  v: alternative,
  p: parallel,
  j: jump,
  a: addAction,
  Enter: name,
  F2: name,
  Delete: remove,
  Backspace: remove,
};

export const same = (a: string, b: string) => keyOf(a) === keyOf(b);
export const has = (names: readonly string[], name: string) => names.some((each) => same(each, name));
export const listed = (names: readonly string[]) => (names.length === 1 ? (names[0] ?? "") : `(${names.join(", ")})`);
export const blanksOf = ({ found, text }: Written, { at }: Span) =>
  lineStartOf(text, at) === 0 ? found.indent : blanksAt(text, at);
export const stepOf = ({ chart }: Written, element: ChartElement) =>
  element.kind === "step" ? element : element.kind === "action" ? stepNamed(chart, element.step) : undefined;
const stepNamed = ({ steps }: Chart, wanted: string) => steps.find((each) => same(each.name, wanted));

/** The edit with the cursor at the element that `is` finds; null where the text cannot be read then. */
export function edited({ found }: Written, text: string, is: (element: ChartElement) => boolean): Edit | null {
  const after = chartOf(found, text);
  const at = after ? elementsOf(after.chart).findIndex(is) : -1;
  return after && { text, place: at < 0 ? [0] : [at], naming: null };
}

export const isStep = (wanted: string) => (element: ChartElement) =>
  element.kind === "step" && same(element.name, wanted);

/** With the names of steps in a list changed by `change`. */
export const relisted = (
  names: readonly string[],
  span: Span,
  change: (names: readonly string[]) => readonly string[],
): Change => ({
  ...span,
  text: listed(change(names)),
});
export const instead = (old: string, wanted: string) => (names: readonly string[]) =>
  names.map((each) => (same(each, old) ? wanted : each));

/** The edit that a new step of any name makes, with the field for its name. */
function withNewStep(around: Around, make: (name: string) => Edit | null): Made {
  const name = newName("Step", around.names);
  const made = make(name);
  const taken = (typed: string) => {
    const wanted = typed.trim();
    return isName(wanted) && !around.names.has(keyOf(wanted)) ? make(wanted) : null;
  };
  return made && { ...made, naming: { value: name, offers: "none", taken } };
}

/** A step after this one, or after this transition, and the transition between. */
function addStep(written: Written, element: ChartElement, around: Around): Made {
  const { text, chart } = written;
  const step = stepOf(written, element);
  const transition = element.kind === "transition" ? element : null;
  const { end } = (step ?? element).span;
  const blanks = blanksOf(written, (step ?? element).span);
  return withNewStep(around, (name) => {
    const lines = [`STEP ${name}:`, "END_STEP"];
    const changes: Change[] = [];
    if (step) {
      lines.unshift(`TRANSITION FROM ${step.name} TO ${name} := ${NOTHING}; END_TRANSITION`);
      for (const { from, fromAt } of chart.transitions)
        if (has(from, step.name)) changes.push(relisted(from, fromAt, instead(step.name, name)));
    } else if (transition) {
      lines.push(`TRANSITION FROM ${name} TO ${listed(transition.to)} := ${NOTHING}; END_TRANSITION`);
      changes.push({ ...transition.toAt, text: name });
    }
    const put = { at: end, end, text: lines.map((line) => `\n${blanks}${line}`).join("") };
    return edited(written, changed(text, [...changes, put]), isStep(name));
  });
}

/** A transition beside this one, or beside the one after this step, from the same steps to the same steps. */
function alternative(written: Written, element: ChartElement, around: Around): Made {
  const { text, chart } = written;
  const step = stepOf(written, element);
  const beside =
    element.kind === "transition" ? element : chart.transitions.find(({ from }) => step && has(from, step.name));
  if (!beside) return addStep(written, element, around);
  const { end } = beside.span;
  const line = `TRANSITION FROM ${listed(beside.from)} TO ${listed(beside.to)} := ${NOTHING}; END_TRANSITION`;
  const made = changed(text, [{ at: end, end, text: `\n${blanksOf(written, beside.span)}${line}` }]);
  return conditionNamed(written, made, (each) => each.kind === "transition" && each.span.at > beside.span.at);
}

/** A step that begins and ends with this one, or with the one after this transition. */
function parallel(written: Written, element: ChartElement, around: Around): Made {
  const { text, chart } = written;
  const step = element.kind === "transition" ? stepNamed(chart, element.to[0] ?? "") : stepOf(written, element);
  if (!step || !chart.transitions.some(({ to }) => has(to, step.name))) return { refused: "graphic.refused.parallel" };
  const { end } = step.span;
  return withNewStep(around, (name) => {
    const also = (names: readonly string[]) => [...names, name];
    const changes = chart.transitions.flatMap(({ from, fromAt, to, toAt }) => [
      ...(has(from, step.name) ? [relisted(from, fromAt, also)] : []),
      ...(has(to, step.name) ? [relisted(to, toAt, also)] : []),
    ]);
    const blanks = blanksOf(written, step.span);
    const put = { at: end, end, text: `\n${blanks}STEP ${name}:\n${blanks}END_STEP` };
    return edited(written, changed(text, [...changes, put]), isStep(name));
  });
}

/** The steps that a transition after this one waits for: those at the open ends of the sequences that begin together with its own. */
function endingWith({ transitions }: Chart, step: ChartStep): readonly string[] {
  const open = (name: string, steps = 0): string | null => {
    const next = transitions.filter(({ from }) => has(from, name));
    const [only] = next;
    if (!only) return name;
    const goes = next.length === 1 && only.from.length === 1 && only.to.length === 1 && steps < transitions.length;
    return goes ? open(only.to[0] ?? "", steps + 1) : null;
  };
  for (const { to } of transitions) {
    const ends = to.map((name) => open(name));
    if (to.length > 1 && ends.some((end) => end !== null && same(end, step.name)) && !ends.includes(null))
      return ends.filter((end) => end !== null);
  }
  return [step.name];
}

/** A transition from this step to a step that is named, or different steps after this transition. */
function jump(written: Written, element: ChartElement): Made {
  const { text, chart } = written;
  const step = stepOf(written, element);
  const namesOf = (typed: string) => {
    const names = typed.split(",").map((each) => stepNamed(chart, each.trim())?.name);
    return names.every((each) => each !== undefined) ? names : null;
  };
  if (element.kind === "transition") {
    const taken = (typed: string) => {
      const names = namesOf(typed);
      const made = names && changed(text, [{ ...element.toAt, text: listed(names) }]);
      return made === null ? null : edited(written, made, (each) => each.span.at === element.span.at);
    };
    const made = edited(written, text, (each) => each === element || each.span.at === element.span.at);
    return made && { ...made, naming: { value: element.to.join(", "), offers: "step", taken } };
  }
  if (!step) return null;
  const { end } = step.span;
  const to = (names: readonly string[]) => {
    const line = `TRANSITION FROM ${listed(endingWith(chart, step))} TO ${listed(names)} := ${NOTHING}; END_TRANSITION`;
    const made = changed(text, [{ at: end, end, text: `\n${blanksOf(written, step.span)}${line}` }]);
    return edited(written, made, (each) => each.span.at > end);
  };
  const made = to([chart.steps[0]?.name ?? step.name]);
  const taken = (typed: string) => {
    const names = namesOf(typed);
    return names && to(names);
  };
  return made && { ...made, naming: { value: "", offers: "step", taken } };
}

/** An action of this step, in the form of the text: `motor`, `lamp(D, T#500ms)`. */
function addAction(written: Written, element: ChartElement): Made {
  const { text } = written;
  const step = stepOf(written, element);
  if (!step) return null;
  const put = actionPut(written, step);
  const is = (each: ChartElement) =>
    each.kind === "action" && each.step === step.name && each.span.at > (step.actions.at(-1)?.span.at ?? 0);
  const made = edited(written, changed(text, [put(`${NOTHING}(N)`)]), is);
  return (
    made && {
      ...made,
      naming: { value: "", ...actionField, taken: actionTaken(written, step.actions.length + 1, put, is) },
    }
  );
}

/** One more action in a step. */
export function actionPut(written: Written, step: ChartStep): (action: string) => Change {
  const { text } = written;
  const word = text.slice(0, step.span.end).toUpperCase().lastIndexOf("END_STEP");
  const start = lineStartOf(text, word);
  const alone = text.slice(start, word).trim() === "";
  const blanks = blanksOf(written, step.span);
  return (action) =>
    alone
      ? { at: start, end: start, text: `${blanks}    ${action};\n` }
      : { at: word, end: word, text: `\n${blanks}    ${action};\n${blanks}` };
}

const actionField = { offers: "bool" as const, example: "motor(N)" };

function actionTaken(
  written: Written,
  count: number,
  put: (action: string) => Change,
  is: (element: ChartElement) => boolean,
): Naming["taken"] {
  return withDeclared((typed) => {
    const wanted = typed.trim();
    if (!isOnePiece(wanted)) return null;
    const action = wanted.includes("(") ? wanted : `${wanted}(N)`;
    if (!/^[\p{L}_%][\p{L}\p{N}_.[\]]*\s*\([^()]*\)$/u.test(action)) return null;
    const made = edited(written, changed(written.text, [put(action)]), is);
    const after = made && chartOf(written.found, made.text);
    const element = after && elementsOf(after.chart).find(is);
    const step = element?.kind === "action" ? stepNamed(after?.chart ?? written.chart, element.step) : undefined;
    return step?.actions.length === count ? made : null;
  });
}

function name(written: Written, element: ChartElement, around: Around): Made {
  const at = (each: ChartElement) => each.kind === element.kind && each.span.at === element.span.at;
  if (element.kind === "step") {
    const made = edited(written, written.text, at);
    const taken = (typed: string) => renamed(written, element, typed.trim(), around);
    return made && { ...made, naming: { value: element.name, offers: "none", taken } };
  }
  if (element.kind === "transition")
    return element.rung ? { refused: "graphic.refused.rung" } : conditionNamed(written, written.text, at);
  const made = edited(written, written.text, at);
  const step = stepNamed(written.chart, element.step);
  const put = (action: string) => ({ ...element.span, text: action });
  const taken = actionTaken(written, step?.actions.length ?? 0, put, at);
  const value = written.text.slice(element.span.at, element.span.end);
  return made && { ...made, naming: { ...actionField, value, taken } };
}

function conditionNamed(written: Written, text: string, is: (element: ChartElement) => boolean): Made {
  const after = chartOf(written.found, text);
  const transition = after && elementsOf(after.chart).find(is);
  const made = edited(written, text, is);
  if (!made || transition?.kind !== "transition") return null;
  const value = transition.condition === NOTHING ? "" : transition.condition;
  const taken = withDeclared((typed) => {
    const wanted = typed.trim();
    if (!isOnePiece(wanted) || /\bEND_\w+\b/i.test(wanted)) return null;
    return edited(written, changed(text, [{ ...transition.conditionAt, text: wanted }]), is);
  });
  return { ...made, naming: { value, offers: "bool", taken } };
}

/** A different name for a step, in all of the chart: transitions, conditions, and the statements of actions. */
function renamed(written: Written, step: ChartStep, wanted: string, around: Around): Edit | null {
  const { text, chart } = written;
  if (!isName(wanted) || (!same(wanted, step.name) && around.names.has(keyOf(wanted)))) return null;
  const lists = chart.transitions.flatMap(({ fromAt, toAt }) => [fromAt, toAt]);
  const inside = (spans: readonly Span[], at: number) => spans.some((span) => at >= span.at && at < span.end);
  const changes = [...wordsIn(text)].flatMap(({ word, at }): Change[] => {
    const end = at + word.length;
    if (word !== keyOf(step.name)) return [];
    // A member of something else, and the name of a parameter, only look like the step.
    const other = /\.\s*$/.test(text.slice(0, at)) || /^\s*(?::=|=>)/.test(text.slice(end));
    return other && !inside([...lists, step.named], at) ? [] : [{ at, end, text: wanted }];
  });
  return edited(written, changed(text, changes), isStep(wanted));
}

/** Without this element, and the line that is empty then. */
export function without(text: string, { at, end }: Span): Change {
  const start = lineStartOf(text, at);
  const rest = /^[ \t]*;?[ \t]*(?=\n|$)/.exec(text.slice(end));
  if (rest && start > 0 && text.slice(start, at).trim() === "")
    return { at: start - 1, end: end + rest[0].length, text: "" };
  return { at, end: end + (/^\s*;?[ \t]*/.exec(text.slice(end))?.[0].length ?? 0), text: "" };
}

/** A step goes with the transitions after it: what led to it leads to the step that followed. */
function remove(written: Written, element: ChartElement): Made {
  const { text, chart } = written;
  const at = elementsOf(chart).findIndex((each) => each.span.at === element.span.at && each.kind === element.kind);
  const done = (changes: readonly Change[]): Edit => ({
    text: changed(text, changes),
    place: [Math.max(0, at - 1)],
    naming: null,
  });
  if (element.kind !== "step") return done([without(text, element.span)]);
  const { name } = element;
  if (element.initial) return { refused: "graphic.refused.initial" };
  const rest = (names: readonly string[]) => names.filter((each) => !same(each, name));
  const next = chart.transitions.find(({ from, to }) => from.length === 1 && has(from, name) && !has(to, name));
  const changes = chart.transitions.flatMap(({ from, fromAt, to, toAt, span }): Change[] => {
    if (has(from, name) && from.length === 1) return [without(text, span)];
    if (has(to, name) && to.length === 1 && !next) return [without(text, span)];
    return [
      ...(has(from, name) ? [relisted(from, fromAt, rest)] : []),
      ...(has(to, name) ? [relisted(to, toAt, (names) => (names.length > 1 ? rest(names) : (next?.to ?? names)))] : []),
    ];
  });
  return done([...changes, without(text, element.span)]);
}
