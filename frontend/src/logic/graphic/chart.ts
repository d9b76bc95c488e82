/** A sequential function chart as it is drawn. Conditions and actions are slices of the text. The grammar is that of `docs/charts.md`. */

import type { Path, Span } from "./tree";

export interface ChartAction {
  kind: "action";
  /** A BOOL variable, or the name of an ACTION. */
  action: string;
  qualifier: string;
  /** As written; empty without one. */
  duration: string;
  indicator: string;
  /** The name of the step that has it. */
  step: string;
  span: Span;
}

export interface ChartStep {
  kind: "step";
  name: string;
  initial: boolean;
  actions: readonly ChartAction[];
  /** Where its name is written. */
  named: Span;
  span: Span;
}

export interface ChartTransition {
  kind: "transition";
  name: string;
  priority: number | null;
  from: readonly string[];
  to: readonly string[];
  /** The expression, or the text of the rung on one line. */
  condition: string;
  /** The elements of the rung whose power is the condition; null where the condition is an expression. */
  rung: Path | null;
  /** Where the steps are written, with their brackets, and the condition. */
  fromAt: Span;
  toAt: Span;
  conditionAt: Span;
  span: Span;
}

export interface Chart {
  kind: "chart";
  steps: readonly ChartStep[];
  transitions: readonly ChartTransition[];
  /** Where the statements of each action are written. */
  bodies: readonly { name: string; span: Span }[];
}

/** Names of steps and actions are the same in capitals and small letters. */
export const keyOf = (name: string) => name.toUpperCase();

const NONE = Number.MAX_SAFE_INTEGER;

/** Transitions in the order in which they are tested: by priority, those without one last, then as they are written. */
export const inTestOrder = (transitions: readonly ChartTransition[]): ChartTransition[] =>
  [...transitions].sort((a, b) => (a.priority ?? NONE) - (b.priority ?? NONE));
