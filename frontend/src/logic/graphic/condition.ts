/**
 * Whether a condition holds, as far as the values of its variables tell: BOOL operators, and comparisons of whole numbers, times and
 * reals. What has a call or arithmetic in it is computed by the PLC only, and not known here (null).
 */

import type { Power } from "./power";

export type Condition =
  | { kind: "value"; text: string }
  | { kind: "variable"; name: string }
  | { kind: "not"; of: Condition }
  | { kind: "and" | "or" | "xor"; left: Condition; right: Condition }
  | { kind: "compare"; by: string; left: Condition; right: Condition };

const TOKEN =
  /\s*(?:(\(\*[\s\S]*?\*\))|([A-Za-z_]+#[\w.+-]+|\d+#[\w]+|\d[\d_]*(?:\.\d[\d_]*)?(?:[eE][+-]?\d+)?)|([\p{L}_%][\p{L}\p{N}_.]*(?:\[[\p{N}\s,-]+\][\p{L}\p{N}_.]*)*)|(<=|>=|<>|[=<>()&-]))/uy;

function tokensOf(text: string): string[] | null {
  const tokens: string[] = [];
  TOKEN.lastIndex = 0;
  let end = 0;
  while (end < text.trimEnd().length) {
    const found = TOKEN.exec(text);
    if (!found) return null;
    end = TOKEN.lastIndex;
    if (!found[1]) tokens.push(found[0].trim());
  }
  return tokens;
}

/** The parts of a condition; null where it is more than is computed here. */
export function conditionOf(text: string): Condition | null {
  const tokens = tokensOf(text);
  if (!tokens || tokens.length === 0) return null;
  const parser = new Parser(tokens);
  const found = parser.level(0);
  return parser.done() ? found : null;
}

const LEVELS: readonly (readonly string[])[] = [["OR"], ["XOR"], ["AND", "&"], ["=", "<>"], ["<", ">", "<=", ">="]];

class Parser {
  private at = 0;

  constructor(private readonly tokens: readonly string[]) {}

  done = () => this.at === this.tokens.length;

  private peek = () => (this.tokens[this.at] ?? "").toUpperCase();

  level(number: number): Condition | null {
    const operators = LEVELS[number];
    if (!operators) return this.unary();
    let left = this.level(number + 1);
    while (left && operators.includes(this.peek())) {
      const by = this.peek();
      this.at += 1;
      const right = this.level(number + 1);
      if (!right) return null;
      const kind = { OR: "or", XOR: "xor", AND: "and", "&": "and" }[by] as "or" | "xor" | "and" | undefined;
      left = kind ? { kind, left, right } : { kind: "compare", by, left, right };
    }
    return left;
  }

  private unary(): Condition | null {
    const word = this.peek();
    const token = this.tokens[this.at] ?? "";
    this.at += 1;
    if (word === "NOT") {
      const of = this.unary();
      return of && { kind: "not", of };
    }
    if (word === "(") {
      const inner = this.level(0);
      if (this.peek() !== ")") return null;
      this.at += 1;
      return inner;
    }
    if (word === "-") {
      const number = this.tokens[this.at] ?? "";
      this.at += 1;
      return /^\d/.test(number) ? { kind: "value", text: `-${number}` } : null;
    }
    if (word === "TRUE" || word === "FALSE") return { kind: "value", text: word };
    if (/^\d/.test(token) || token.includes("#")) return { kind: "value", text: token };
    // A name with a bracket after it is a call.
    if (!/^[\p{L}_%]/u.test(token) || this.peek() === "(" || LEVELS.flat().includes(word)) return null;
    return { kind: "variable", name: token };
  }
}

/** The variables of a condition; `compared` are those whose values are compared. */
export function variablesOf(condition: Condition | null): { name: string; compared: boolean }[] {
  const found = new Map<string, boolean>();
  const visit = (part: Condition, compared: boolean): void => {
    if (part.kind === "variable") found.set(part.name, compared || found.get(part.name) === true);
    if (part.kind === "not") visit(part.of, false);
    if ("left" in part) for (const each of [part.left, part.right]) visit(each, part.kind === "compare");
  };
  if (condition) visit(condition, false);
  return [...found].map(([name, compared]) => ({ name, compared }));
}

export const hasNumbers = (text: string) => variablesOf(conditionOf(text)).some(({ compared }) => compared);

/** Whether the condition holds; `read` gives the text of a value, null where it is not known. */
export function holdsBy(condition: Condition | null, read: (variable: string) => string | null): Power {
  const text = condition && textOf(condition, read);
  return text === "TRUE" ? true : text === "FALSE" ? false : null;
}

/** Whether a variable or an expression is TRUE; null where that is not known here. */
export const truthBy = (text: string, read: (variable: string) => string | null): Power =>
  holdsBy(conditionOf(text), read);

/** The text of the value that an expression has; null where it is not known here. */
export function valueBy(text: string, read: (variable: string) => string | null): string | null {
  const parsed = conditionOf(text);
  return parsed && textOf(parsed, read);
}

type Read = (variable: string) => string | null;
const word = (value: Power) => (value === null ? null : value ? "TRUE" : "FALSE");

function textOf(part: Condition, read: Read): string | null {
  switch (part.kind) {
    case "value":
      return part.text;
    case "variable":
      return read(part.name);
    case "not": {
      const value = holdsBy(part.of, read);
      return word(value === null ? null : !value);
    }
    case "and":
    case "or": {
      const decides = part.kind === "or";
      const [left, right] = [holdsBy(part.left, read), holdsBy(part.right, read)];
      if (left === decides || right === decides) return word(decides);
      return word(left === null || right === null ? null : !decides);
    }
    case "xor": {
      const [left, right] = [holdsBy(part.left, read), holdsBy(part.right, read)];
      return word(left === null || right === null ? null : left !== right);
    }
    case "compare":
      return word(compared(part.by, textOf(part.left, read), textOf(part.right, read)));
  }
}

/** Whether two values compare so, by `>=` for one; null where their texts do not tell. */
export function compared(by: string, left: string | null, right: string | null): Power {
  if (left === null || right === null) return null;
  const sign = signOf(left, right);
  if (sign === null) return null;
  switch (by) {
    case "=":
      return sign === 0;
    case "<>":
      return sign !== 0;
    case "<":
      return sign < 0;
    case ">":
      return sign > 0;
    case "<=":
      return sign <= 0;
    default:
      return sign >= 0;
  }
}

/** Below, at or above zero as `left` is less than, equal to or greater than `right`; null where their texts do not tell. */
function signOf(left: string, right: string): number | null {
  const bools = [left, right].map((each) => ["FALSE", "TRUE"].indexOf(each.toUpperCase()));
  if (!bools.includes(-1)) return Math.sign((bools[0] ?? 0) - (bools[1] ?? 0));
  const [a, b] = [numberOf(left), numberOf(right)];
  if (a === null || b === null) return null;
  if (typeof a === "bigint" && typeof b === "bigint") return a < b ? -1 : a > b ? 1 : 0;
  // Texts of reals are rounded: two that are the same as REAL may be different as LREAL, or after a conversion.
  const [x, y] = [Math.fround(Number(a)), Math.fround(Number(b))];
  return x === y || Number.isNaN(x) || Number.isNaN(y) ? null : x < y ? -1 : 1;
}

const UNITS: Readonly<Record<string, number>> = { d: 864e11, h: 36e11, m: 6e10, s: 1e9, ms: 1e6, us: 1e3, ns: 1 };

/** A whole number or a time in nanoseconds, a real; null where the text is neither. */
function numberOf(text: string): bigint | number | null {
  const time = /^(-?)(?:L?T|L?TIME)#(-?)(.+)$/i.exec(text);
  if (time) return nanoseconds(time[3] ?? "", time[1] !== "" || time[2] !== "");
  const typed = /^(-?)[A-Za-z]+#(.+)$/.exec(text);
  const plain = (typed ? `${typed[1]}${typed[2]}` : text).replaceAll("_", "");
  const based = /^(2|8|16)#([0-9A-Fa-f]+)$/.exec(plain);
  if (based) return Number.isNaN(parseInt(based[2] ?? "", Number(based[1]))) ? null : bigOf(based[1], based[2] ?? "");
  if (/^[+-]?\d+$/.test(plain)) return BigInt(plain);
  return /^[+-]?\d+(?:\.\d+)?(?:e[+-]?\d+)?$/i.test(plain) ? Number(plain) : null;
}

const bigOf = (base: string | undefined, digits: string) =>
  BigInt(`${base === "16" ? "0x" : base === "8" ? "0o" : "0b"}${digits}`);

function nanoseconds(text: string, negative: boolean): bigint | null {
  const plain = text.replaceAll("_", "").toLowerCase();
  if (!/^(?:[\d.]+(?:d|h|ms|us|ns|m|s))+$/.test(plain)) return null;
  let sum = 0n;
  for (const [, digits = "", unit = ""] of plain.matchAll(/([\d.]+)(ms|us|ns|d|h|m|s)/g))
    sum += BigInt(Math.round(Number(digits) * (UNITS[unit] ?? 0)));
  return negative ? -sum : sum;
}
