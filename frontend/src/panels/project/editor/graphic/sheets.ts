import { Sheet } from "../../../../logic/graphic/sheet";

/** What was drawn of the files that were shown last: who comes back from the text finds it again. */
const sheets = new Map<string, Sheet>();
const MOST_SHEETS = 6;

export function sheetOf(path: string): Sheet {
  const known = sheets.get(path) ?? new Sheet();
  sheets.delete(path);
  sheets.set(path, known);
  for (const each of [...sheets.keys()].slice(0, -MOST_SHEETS)) sheets.delete(each);
  return known;
}
