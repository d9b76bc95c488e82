/** Where elements that are dragged can be dropped in a rung. */

import type { Drawing, Place } from "./ladderLayout";

export interface Drop {
  /** What is dropped comes after this place. */
  place: Place;
  x: number;
  y: number;
}

const FAR = 80;

/** After each element and after branches, before what is first in its path, and in what is empty. */
export function dropsOf({ elements, gaps, rail, height }: Drawing): Drop[] {
  if (elements.length === 0) return [{ place: [], x: rail.left + 24, y: Math.round(height / 2) }];
  return [
    ...elements.map(({ place, x, y, width }): Drop => ({ place, x: x + width, y })),
    ...elements
      .filter(({ place }) => place.at(-1) === 0)
      .map(({ place, x, y }): Drop => ({ place: place.slice(0, -1), x, y })),
    ...gaps.map(({ place, x, y, width }): Drop => ({ place, x: x + width / 2, y })),
  ];
}

/** The one that is nearest to a point; null where none is near. */
export function nearestDrop(drops: readonly Drop[], x: number, y: number): Drop | null {
  // What is empty has one place only.
  if (drops.length === 1) return drops[0] ?? null;
  let [best, least]: [Drop | null, number] = [null, FAR];
  for (const drop of drops) {
    const distance = Math.hypot(drop.x - x, 2 * (drop.y - y));
    if (distance < least) [best, least] = [drop, distance];
  }
  return best;
}
