/** The indentation that a line has by the lines above it: after Enter, and where it ends a block. */

/** The text of a line, which counts from 1. */
type LineOf = (line: number) => string;

/** A POU: its sections are at its own level. */
const HEAD = /^\s*(PROGRAM|FUNCTION|FUNCTION_BLOCK|METHOD)\b(?!.*\bEND_)/i;
const SECTION = /^\s*VAR(_\w+)?(?!\w)/i;
/** What the layout puts one level deeper than the line itself. */
const OPENS =
  /(\b(THEN|DO|ELSE|REPEAT|STRUCT|UNION|TYPE)|^\s*CASE\b.*\bOF|^\s*VAR(_\w+)?\b(?!.*\bEND_VAR\b).*|:)\s*$|^\s*(NAMESPACE|CONFIGURATION|RESOURCE|INTERFACE)\b(?!.*\bEND_)|^\s*(\{off\}\s*)?(RUNG|NETWORK)\b(?!\s*(:=|\.|\[|\()|.*\bEND_)/i;
const ENDS = /^\s*(?:END_(\w+)|(ELSE|ELSIF)|(UNTIL))(?!\w)/i;

export const blanksOf = (text: string) => /^[ \t]*/.exec(text)?.[0] ?? "";

/** A line without its comments and strings, as far as they are in this line. */
const codeOf = (text: string) => text.replace(/\(\*.*?(\*\)|$)|\/\/.*$|'(\$.|[^'$])*('|$)/g, "");

/** For a new line: that of the one above which has text, one level deeper if that begins something. */
export function indentAfter(lineOf: LineOf, line: number, unit: string): string {
  for (let above = line - 1; above > 0; above -= 1) {
    const text = lineOf(above);
    if (text.trim() === "") continue;
    // Statements of a POU begin at its own level or one deeper: whoever types them chooses.
    return blanksOf(text) + (OPENS.test(codeOf(text)) ? unit : "");
  }
  return "";
}

/** The line of the POU that a line is in; null outside of one. */
function headOf(lineOf: LineOf, line: number): number | null {
  let ended = 0;
  for (let above = line; above > 0; above -= 1) {
    const code = codeOf(lineOf(above));
    if (/^\s*END_(PROGRAM|FUNCTION|FUNCTION_BLOCK|METHOD)\b/i.test(code)) ended += 1;
    else if (HEAD.test(code)) {
      if (ended === 0) return above;
      ended -= 1;
    }
  }
  return null;
}

/** That of the line whose block or POU this line ends, divides or goes on with; null where it does not, or nothing is open. */
export function indentOfOpener(lineOf: LineOf, line: number): string | null {
  if (SECTION.test(lineOf(line))) {
    const head = headOf(lineOf, line - 1);
    return head === null ? null : blanksOf(lineOf(head));
  }
  const [, end, branch, until] = ENDS.exec(lineOf(line)) ?? [];
  const words = end ? [end] : branch ? (/^ELSE$/i.test(branch) ? ["IF", "CASE"] : ["IF"]) : until ? ["REPEAT"] : [];
  if (words.length === 0) return null;
  const closes = new RegExp(`\\bEND_(${words.join("|")})\\b`, "i");
  const opens = new RegExp(
    `(^|:|\\})\\s*(${words.join("|")}${end?.toUpperCase() === "VAR" ? "(_\\w+)?" : ""})\\b`,
    "i",
  );
  let inner = 0;
  for (let above = line - 1; above > 0; above -= 1) {
    const code = codeOf(lineOf(above));
    const closed = closes.test(code);
    const opened = opens.test(code);
    if (opened && !closed && inner === 0) return blanksOf(lineOf(above));
    if (closed !== opened) inner += closed ? 1 : -1;
  }
  return null;
}
