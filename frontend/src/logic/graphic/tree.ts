/**
 * A rung as it is drawn. Operands are slices of the text, which only the compiler understands. The grammar is that of
 * `docs/ladder.md`.
 */

/** The part of a text that an element is written in: offsets from the start of its network. */
export interface Span {
  at: number;
  end: number;
}

export type ContactMode = "" | "/" | "P" | "N";
export type CoilMode = "" | "/" | "S" | "R" | "P" | "N";

export interface Contact {
  kind: "contact";
  mode: ContactMode;
  operand: string;
  span: Span;
}

export interface Coil {
  kind: "coil";
  mode: CoilMode;
  operand: string;
  span: Span;
}

/** An argument of a call: a value that goes in, or a variable or a wire that takes an output. */
export interface Argument {
  /** Null without a name. */
  name: string | null;
  out: boolean;
  /** `~` is the power that comes in. */
  value: string;
  /** Contacts of its own, from the rail; then `value` is empty. */
  branch: Parallel | null;
  span: Span;
}

export interface Box {
  kind: "box";
  /** The variable that takes the result; null without one. */
  result: string | null;
  callee: string;
  args: readonly Argument[];
  /** The output that the power goes on from; null: it goes on as it came. */
  output: string | null;
  span: Span;
}

export interface Parallel {
  kind: "parallel";
  branches: readonly Path[];
  span: Span;
}

/** `-> #name` sends the power and ends its path; `#name` receives it. */
interface Link {
  kind: "send" | "receive";
  name: string;
  span: Span;
}

/** A jump to a label, or the end of the POU if there is none; it ends its path. */
export interface Jump {
  kind: "jump";
  label: string | null;
  span: Span;
}

export type Element = Contact | Coil | Box | Parallel | Link | Jump;
export type Path = readonly Element[];

/** What a network says about itself in the first lines. */
export interface Head {
  label: string;
  title: string;
  /** The lines of its comment, without their marks. */
  comment: readonly string[];
  /** `{off}`: drawn grey, not compiled. */
  off: boolean;
}

export interface Rung {
  kind: "rung";
  head: Head;
  path: Path;
}

/** Why a network could not be read, and where: an offset from its start. */
export interface Unread {
  kind: "unread";
  at: number;
  /** What was expected there, as a key of the page's texts. */
  expected: "element" | "close" | "operand" | "end" | "comment" | "item";
}
