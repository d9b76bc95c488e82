/** A function block diagram as it is drawn: one item a line, in the order of execution. The grammar is that of `docs/ladder.md`. */

import type { Span } from "./tree";

/** What goes into a box, or to a variable. */
export interface DiagramPin {
  /** The value without what is below; a slice of the text. */
  text: string;
  negated: boolean;
  /** `P` looks for a rising edge, `N` for a falling one. */
  edge: "" | "P" | "N";
  /** The key of the wire that it is; null for a variable, a literal or an expression. */
  wire: string | null;
  /** Where the value is written, with what negates it or looks for an edge. */
  span: Span;
}

export interface DiagramInput extends DiagramPin {
  /** Empty without one. */
  name: string;
  /** The whole argument, with its name; of what is no box the same as `span`. */
  arg: Span;
}

export interface DiagramOutput {
  /** Empty for the result of a function. */
  name: string;
  negated: boolean;
  /** The variable or wire that takes the output. */
  target: string;
  /** The key of the wire that it is; null for a variable. */
  wire: string | null;
  operator: "" | "S" | "R";
  /** Where the target is written. */
  span: Span;
  /** The whole argument, with its name; null for the result. */
  arg: Span | null;
}

export interface DiagramItem {
  kind: "box" | "value" | "leave";
  /** Of a box. */
  callee: string;
  /** Of what is no box one, without a name; none of a jump without a condition. */
  inputs: readonly DiagramInput[];
  /** Of a jump none. */
  outputs: readonly DiagramOutput[];
  /** Where a jump goes to; empty for RETURN, and for what is no jump. */
  label: string;
  /** Where the callee of a box is written, or the label of a jump; null for others. */
  named: Span | null;
  /** What is between the brackets of a box; null for others. */
  args: Span | null;
  span: Span;
}

/** The key of a wire as it is written: `#Low` and `#low` are one. */
export const wireOf = (text: string) => (/^#[\p{L}_][\p{L}\p{N}_]*$/u.test(text) ? text.toUpperCase() : null);

/** What is written where nothing is connected or named yet. The compiler refuses it. */
export const NOTHING = "???";
