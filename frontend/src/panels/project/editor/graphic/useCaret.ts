/** The cursor of a drawing follows the caret of the text beside it, as the text follows the cursor (see `elementMark`). */

import { useEffect } from "react";
import type { DrawnPart } from "../../../../logic/graphic/sheet";
import { useDocuments } from "../../../../store/project/documents";
import { type Cursor, sameElement } from "./cursor";
import { placeOfCaret } from "./find";

interface Followed {
  path: string;
  drawn: readonly DrawnPart[];
  cursor: Cursor;
  /** Whether the text is shown. */
  beside: boolean;
  sheet: { current: HTMLElement | null };
}

/** Calls `go` with where the caret is in the drawing, whenever that is a different place. The focus stays in the text. */
export function useCaret({ path, drawn, cursor, beside, sheet }: Followed, go: (to: Cursor) => void): void {
  // A place of an element is the drawing's own cursor.
  const caret = useDocuments(({ active, cursor: at }) => (beside && active === path && !at?.element ? at : null));
  // biome-ignore lint/correctness/useExhaustiveDependencies: once for each place of the caret, and as the text changes under it
  useEffect(() => {
    if (!caret || sheet.current?.contains(document.activeElement)) return;
    const to = placeOfCaret(drawn, caret);
    if (to && (to.rung !== cursor.rung || !sameElement(to.place, cursor.place))) go(to);
  }, [caret, drawn]);
}
