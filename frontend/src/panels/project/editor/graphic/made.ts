/** What a key makes of a part of a drawing at a place. */

import { chartEdit } from "../../../../logic/graphic/chartKeys";
import { diagramEdit } from "../../../../logic/graphic/diagramKeys";
import type { Around, Made } from "../../../../logic/graphic/edit";
import { headEdit } from "../../../../logic/graphic/head";
import { rungEdit } from "../../../../logic/graphic/keys";
import type { Place } from "../../../../logic/graphic/ladderLayout";
import type { DrawnPart } from "../../../../logic/graphic/sheet";
import type { TextKey } from "../../../../text";

const NOT_HERE: readonly TextKey[] = ["graphic.refused.pin", "graphic.refused.input"];

/** Whether a key means something at a place. What is refused for the sake of the text means something: the refusal says why. */
export function canPress(part: DrawnPart, key: string, place: Place, around: (part: DrawnPart) => Around): boolean {
  const made = madeOf(part, key, place, around);
  return made !== null && !("refused" in made && NOT_HERE.includes(made.refused));
}

export function madeOf(part: DrawnPart, key: string, place: Place, around: (part: DrawnPart) => Around): Made {
  const { found } = part;
  const { text, head, indent } = found;
  const made = part.kind === "chart" ? null : headEdit(found, key, place);
  if (made) return made;
  if (part.kind === "network") return diagramEdit(text, key, place, around(part));
  if (part.kind === "chart") return chartEdit(found, key, place, around(part));
  const { path, comments } = part;
  // Where a letter with Shift means nothing else it means the letter.
  const plain = /^Shift\+[fj#]$/i.test(key) ? key : key.replace("Shift+", "");
  if (path !== null) return rungEdit({ head, path, indent, comments }, plain, place);
  return rungEdit({ head, path: [], indent, comments: false }, plain, []) && { refused: "graphic.refused.unread" };
}
