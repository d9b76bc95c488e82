/** The variables that a line of Structured Text names; their values are shown at the end of the line. */

export interface NamedVariable {
  /** The path as written, up to the first index that is known only at run time: `belt[3].speed`; of `a[i].x` it is `a`. */
  path: string;
  /** The column at which it begins, from 1. */
  column: number;
}

const NAME = /[\p{L}_][\p{L}\d_]*/uy;
const STEP = /(?:\.\s*[\p{L}_][\p{L}\d_]*)|\[\s*-?\d+(?:\s*,\s*-?\d+)*\s*\]|\^/uy;

/** Each variable once, in the order of the line. `comment` says whether the line begins inside a comment, `step` whether inside a step of a chart. */
export function variablesIn(
  line: string,
  comment = false,
  step = false,
): { variables: NamedVariable[]; comment: boolean } {
  const variables: NamedVariable[] = [];
  const seen = new Set<string>();
  let at = 0;
  let open = comment;
  while (at < line.length) {
    if (open) {
      const end = /\*\)|\*\//.exec(line.slice(at));
      if (!end) return { variables, comment: true };
      at += end.index + 2;
      open = false;
      continue;
    }
    const skipped = skip(line, at);
    if (skipped === "comment") open = true;
    if (typeof skipped === "number") {
      at = skipped;
      continue;
    }
    if (skipped === "comment") {
      at += 2;
      continue;
    }
    const found = take(line, at, step);
    if (!found) {
      at += 1;
      continue;
    }
    at = found.end;
    const key = found.path.toUpperCase();
    if (found.named && !seen.has(key)) {
      seen.add(key);
      variables.push({ path: found.path, column: found.column });
    }
  }
  return { variables, comment: open };
}

/** The index after a string, a line comment, a number or a typed literal; `comment` where a block comment begins. */
function skip(line: string, at: number): number | "comment" | null {
  const rest = line.slice(at);
  if (rest.startsWith("//")) return line.length;
  if (rest.startsWith("(*") || rest.startsWith("/*")) return "comment";
  const quoted = /^'(?:\$.|[^'$])*'?|^"(?:\$.|[^"$])*"?|^\{[^}]*\}?/.exec(rest);
  if (quoted) return at + quoted[0].length;
  const literal = /^[\p{L}_][\p{L}\d_]*#[\p{L}\d_.:+-]*|^%?\d[\d_.a-z#]*/iu.exec(rest);
  return literal ? at + literal[0].length : null;
}

/** Of contacts and coils, `[P a]`, `(S a)`, and of actions in a step, `a(N)`. */
const MODE = /^[PNSR]$/i;
const QUALIFIER = /^(?:[NRSLDP]|SD|DS|SL|P[01])$/i;

function take(
  line: string,
  at: number,
  inStep: boolean,
): { path: string; column: number; end: number; named: boolean } | null {
  NAME.lastIndex = at;
  const first = NAME.exec(line);
  if (!first) return null;
  let path = first[0];
  let end = NAME.lastIndex;
  for (;;) {
    STEP.lastIndex = end;
    const step = STEP.exec(line);
    if (!step) break;
    path += step[0].replace(/\s+/g, "");
    end = STEP.lastIndex;
  }
  const rest = line.slice(end);
  // Not variables of this place: the name of a call, the name of a parameter, and a member whose owner has no fixed path.
  const call = /^\s*\((?!\*)/.test(rest);
  const member = /\.\s*$/.test(line.slice(0, at));
  const parameter = /^\s*(:=|=>)/.test(rest) && /[(,]\s*(NOT\s+)?$/i.test(line.slice(0, at));
  const mode =
    MODE.test(path) && /[[(]\s*$/.test(line.slice(0, at)) && /^\s+(?!(?:AND|OR|XOR|MOD)\b)[\p{L}_%(]/iu.test(rest);
  const qualifier = inStep && QUALIFIER.test(path) && /\(\s*$/.test(line.slice(0, at));
  return { path, column: at + 1, end, named: !call && !parameter && !member && !mode && !qualifier };
}
