/** Finds a text in the files of a project, and replaces it. */

export interface Wanted {
  text: string;
  /** Capital and small letters differ. */
  cased: boolean;
  /** Only whole words. */
  whole: boolean;
  /** The text is a regular expression. */
  regex: boolean;
}

export interface Match {
  /** Position in the text, and the length of what was found. */
  at: number;
  length: number;
  /** What was found, and then the groups of the expression. */
  groups: readonly string[];
  /** From 1. */
  line: number;
  column: number;
  /** The line around it, as far as it is shown. */
  before: string;
  after: string;
}

/** What is found in one file is a list no longer than this. */
export const MOST = 1000;
const SHOWN_BEFORE = 40;
const SHOWN_AFTER = 120;

/** What is looked for; null where the expression is none. */
export function pattern({ text, cased, whole, regex }: Wanted): RegExp | null {
  const plain = regex ? text : text.replace(/[.*+?^${}()|[\]\\]/g, "\\$&");
  try {
    return new RegExp(whole ? `(?<![\\p{L}\\p{N}_])(?:${plain})(?![\\p{L}\\p{N}_])` : plain, cased ? "gmu" : "gimu");
  } catch {
    return null;
  }
}

/** The places of a text where the pattern is found, at most `MOST`; what is found empty is left out. */
export function matches(text: string, wanted: RegExp): Match[] {
  const made: Match[] = [];
  let line = 1;
  let start = 0;
  for (const found of text.matchAll(wanted)) {
    const [whole] = found;
    if (whole === "") continue;
    for (let end = text.indexOf("\n", start); end >= 0 && end < found.index; end = text.indexOf("\n", start)) {
      line += 1;
      start = end + 1;
    }
    const last = text.indexOf("\n", found.index + whole.length);
    const lead = text.slice(start, found.index).trimStart();
    made.push({
      at: found.index,
      length: whole.length,
      groups: [...found].map((group) => group ?? ""),
      line,
      column: found.index - start + 1,
      before: lead.length > SHOWN_BEFORE ? `…${lead.slice(-SHOWN_BEFORE)}` : lead,
      after: text.slice(found.index + whole.length, last < 0 ? undefined : last).slice(0, SHOWN_AFTER),
    });
    if (made.length === MOST) break;
  }
  return made;
}

/** What a match becomes; in an expression `$1` is its first group, `$&` the whole. */
export function replacement({ groups }: Match, by: string, regex: boolean): string {
  if (!regex) return by;
  return by.replace(/\$([$&]|\d)/g, (_, sign: string) =>
    sign === "$" ? "$" : (groups[sign === "&" ? 0 : Number(sign)] ?? ""),
  );
}

/** The text with these matches replaced. */
export function replaced(text: string, which: readonly Match[], to: (match: Match) => string): string {
  let made = "";
  let at = 0;
  for (const match of which) {
    made += text.slice(at, match.at) + to(match);
    at = match.at + match.length;
  }
  return made + text.slice(at);
}
