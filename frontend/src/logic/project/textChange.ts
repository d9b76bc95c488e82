/** What of a text is replaced by what, as LSP says it: lines from 0, columns in UTF-16 units. */
interface Change {
  range: { start: Place; end: Place };
  text: string;
}

interface Place {
  line: number;
  character: number;
}

/** The one stretch in which two texts differ; null when they are the same. */
export function textChange(before: string, after: string): Change | null {
  if (before === after) return null;
  const shortest = Math.min(before.length, after.length);
  let start = 0;
  while (start < shortest && before.charCodeAt(start) === after.charCodeAt(start)) start += 1;
  if (isHigh(before.charCodeAt(start - 1))) start -= 1;
  let end = 0;
  while (
    end < shortest - start &&
    before.charCodeAt(before.length - 1 - end) === after.charCodeAt(after.length - 1 - end)
  )
    end += 1;
  if (isHigh(before.charCodeAt(before.length - 1 - end))) end -= 1;
  const last = before.length - Math.max(end, 0);
  return {
    range: { start: placeAt(before, start), end: placeAt(before, last) },
    text: after.slice(start, after.length - Math.max(end, 0)),
  };
}

/** The first half of a character of two units, which must not be cut. */
const isHigh = (unit: number) => unit >= 0xd800 && unit < 0xdc00;

function placeAt(text: string, at: number): Place {
  let line = 0;
  let begin = 0;
  for (let next = text.indexOf("\n"); next >= 0 && next < at; next = text.indexOf("\n", begin)) {
    line += 1;
    begin = next + 1;
  }
  return { line, character: at - begin };
}
