/** Where the cursor goes from an element of a drawing. */

import type { Way } from "./ladderLayout";
import type { Spot } from "./sheet";

const middle = ({ x, y, width, axis }: Spot) => [axis ?? x + width / 2, y] as const;

/** The index of the next element in a direction; null where there is none. */
export function next(elements: readonly Spot[], from: number, way: Way): number | null {
  const here = elements[from];
  if (!here) return null;
  const [x, y] = middle(here);
  let best: number | null = null;
  let least = Number.POSITIVE_INFINITY;
  elements.forEach((each, index) => {
    const [dx, dy] = [middle(each)[0] - x, middle(each)[1] - y];
    const [along, across] = way === "left" || way === "right" ? [dx, dy] : [dy, dx];
    const ahead = way === "left" || way === "up" ? -along : along;
    // What is in the same row or column comes before what is nearer, but beside it.
    const distance = ahead + 3 * Math.abs(across);
    if (ahead > 1 && distance < least) [best, least] = [index, distance];
  });
  return best;
}
