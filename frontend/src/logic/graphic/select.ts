/** Several elements of a part at once: those between two places, their text, the part without them, or with them in a different place. */

import { chartEdit, elementsOf } from "./chartKeys";
import { readChart } from "./charts";
import { diagramOf, withoutItem } from "./diagramEdit";
import type { Around, Edit, Made, Refused } from "./edit";
import { elementAt, insert, insertBranch } from "./ladderEdit";
import type { Place } from "./ladderLayout";
import { writeRung } from "./ladderWrite";
import type { Found } from "./networks";
import { type DrawnPart, type DrawnRung, spotsOf } from "./sheet";
import type { Element, Path } from "./tree";

const UNFIT: Refused = { refused: "graphic.refused.move" };

/** What lies between two places: of a rung elements beside each other, branches that are crossed as a whole; of others lines or elements. */
export function between(part: DrawnPart, from: Place, to: Place): readonly Place[] {
  if (part.kind !== "rung") {
    const [first = 0, last = 0] = [from[0], to[0]].sort((a = 0, b = 0) => a - b);
    return spotsOf(part)
      .map(({ place }) => place)
      .filter(([index = -1]) => index >= first && index <= last);
  }
  const { path } = part;
  if (path === null) return [];
  let depth = 0;
  const goesOn = (place: Place) => place.length >= depth + 2;
  while (goesOn(from) && goesOn(to) && from[depth] === to[depth] && from[depth + 1] === to[depth + 1]) depth += 2;
  const [a, b] = [from[depth] ?? 0, to[depth] ?? 0];
  const around = from.slice(0, depth);
  const all = Array.from({ length: Math.abs(a - b) + 1 }, (_, index) => [...around, Math.min(a, b) + index]);
  return all.filter((place) => elementAt(path, place) !== null);
}

const isInside = (place: Place, outer: Place) =>
  place.length > outer.length && outer.every((each, index) => each === place[index]);

/** The chosen elements of a rung in the order of the text, without those inside of others. */
function elementsAt(path: Path, places: readonly Place[]): Element[] {
  const outer = places.filter((place) => !places.some((other) => isInside(place, other)));
  return outer.flatMap((place) => elementAt(path, place) ?? []).sort((a, b) => a.span.at - b.span.at);
}

/** Their text, as it is copied. */
export function textOf(part: DrawnPart, places: readonly Place[]): string {
  const { text } = part.found;
  if (part.kind === "rung")
    return elementsAt(part.path ?? [], places)
      .map(({ span }) => text.slice(span.at, span.end))
      .join(" ");
  const wanted = new Set(places.map(([index]) => index));
  const all = spotsOf(part).filter(({ place: [index] }) => wanted.has(index));
  // What is inside of a step that is chosen, too, is in its text.
  const spots = all.filter(({ element: { span } }) =>
    all.every(({ element: { span: outer } }) => outer === span || span.at <= outer.at || span.end > outer.end),
  );
  const ended = part.kind === "network" ? ";" : "";
  return spots.map(({ element: { span } }) => text.slice(span.at, span.end) + ended).join("\n");
}

/** The path without some elements: a branch that is empty then goes, too, and a parallel with one branch is no parallel. */
function pruned(path: Path, gone: ReadonlySet<Element>): Path {
  return path.flatMap((element): Path => {
    if (gone.has(element)) return [];
    if (element.kind !== "parallel") return [element];
    const branches = element.branches.map((branch) => pruned(branch, gone));
    const left = branches.filter((branch, index) => branch.length > 0 || element.branches[index]?.length === 0);
    if (left.length > 1) return [{ ...element, branches: left }];
    return left[0] ?? [];
  });
}

/** Where an element is in a path; null where it is not. */
function placeOf(path: Path, wanted: Element | undefined): Place | null {
  for (const [index, element] of path.entries()) {
    if (element === wanted) return [index];
    if (element.kind !== "parallel") continue;
    for (const [number, branch] of element.branches.entries()) {
      const found = placeOf(branch, wanted);
      if (found) return [index, number, ...found];
    }
  }
  return null;
}

const written = (part: DrawnRung, path: Path, place: Place): Edit => ({
  ...{ text: writeRung(part.found.head, path, part.found.indent), place, naming: null },
});

/** The part without them. */
export function without(part: DrawnPart, places: readonly Place[], around: Around): Made {
  if (!part.readable) return { refused: "graphic.refused.unread" };
  if (part.kind === "network") return withoutItems(part.found.text, places);
  if (part.kind === "chart") return withoutParts(part, places, around);
  if (part.comments) return { refused: "graphic.comments" };
  const path = part.path ?? [];
  const gone = new Set(elementsAt(path, places));
  const left = pruned(path, gone);
  const first = Math.min(...[...gone].map(({ span }) => span.at));
  const before = leavesOf(left).findLast(({ span }) => span.at < first);
  return written(part, left, placeOf(left, before) ?? []);
}

const leavesOf = (path: Path): Element[] =>
  path.flatMap((element) => (element.kind === "parallel" ? element.branches.flatMap(leavesOf) : [element]));

function withoutItems(text: string, places: readonly Place[]): Made {
  const gone = [...new Set(places.map(([index = 0]) => index))].sort((a, b) => b - a);
  let made = text;
  for (const index of gone) {
    const item = diagramOf(made)?.items[index];
    if (item) made = withoutItem(made, item);
  }
  const left = diagramOf(made)?.items.length ?? 0;
  return { text: made, place: left === 0 ? [] : [Math.min(gone.at(-1) ?? 0, left - 1)], naming: null };
}

/** Of a chart actions and transitions go first: what is left of these follows from the steps that go. */
function withoutParts(part: DrawnPart, places: readonly Place[], around: Around): Made {
  const wanted = new Set(places.map(([index]) => index));
  const chosen = partsOf(part.found).filter((_, index) => wanted.has(index));
  const steps = chosen.flatMap((each) => (each.kind === "step" ? [each.name] : []));
  const others = chosen.filter(({ kind }) => kind !== "step").sort((a, b) => b.span.at - a.span.at);
  let made: Edit = { text: part.found.text, place: [0], naming: null };
  const found = () => ({ ...part.found, text: made.text, body: { at: 0, end: made.text.length } });
  for (const one of [...others.map(({ span }) => span.at), ...steps]) {
    const all = partsOf(found());
    const index = all.findIndex((each) =>
      typeof one === "string"
        ? each.kind === "step" && each.name === one
        : each.kind !== "step" && each.span.at === one,
    );
    if (index < 0) continue;
    const next = chartEdit(found(), "Delete", [index], around);
    if (next && "refused" in next) return next;
    if (next) made = next;
  }
  return made;
}

function partsOf(found: Found) {
  const read = readChart(found);
  return read.kind === "chart" ? elementsOf(read) : [];
}

/** An empty branch below them; null where they are not beside each other. */
export function branched(part: DrawnPart, places: readonly Place[]): Made {
  if (part.kind !== "rung" || part.path === null) return null;
  if (part.comments) return { refused: "graphic.comments" };
  const sorted = [...places].sort((a, b) => (a.at(-1) ?? 0) - (b.at(-1) ?? 0));
  const [first] = sorted;
  const beside = sorted.every(
    (place, index) =>
      place.slice(0, -1).join() === first?.slice(0, -1).join() && place.at(-1) === (first.at(-1) ?? 0) + index,
  );
  const made = first && beside ? insertBranch(part.path, first, sorted.length) : null;
  return made ? written(part, made.path, made.place) : UNFIT;
}

/** Elements of a rung after a place of this or a different one: the text of where they go, and of where they were if that is not the same. */
export function moved(
  from: DrawnRung,
  places: readonly Place[],
  to: DrawnRung,
  place: Place,
): Refused | { target: Edit; source: Edit | null } {
  if (from.path === null || to.path === null) return { refused: "graphic.refused.unread" };
  if (from.comments || to.comments) return { refused: "graphic.comments" };
  const elements = elementsAt(from.path, places);
  const inner = from === to && places.some((each) => isInside(place, each));
  if (elements.length === 0 || inner) return UNFIT;
  const copies = elements.map((element): Element => ({ ...element }));
  let put = { path: to.path, place };
  for (const each of copies) put = insert(put.path, put.place, each);
  const gone = new Set(elements);
  const whole = from === to ? pruned(put.path, gone) : put.path;
  if (!endsWell(whole)) return UNFIT;
  const target = written(to, whole, placeOf(whole, copies.at(-1)) ?? []);
  return { target, source: from === to ? null : written(from, pruned(from.path, gone), []) };
}

/** Whether nothing comes after what ends its path. */
const endsWell = (path: Path): boolean =>
  path.every((element, index) => {
    if (element.kind === "parallel") return element.branches.every(endsWell);
    return (element.kind !== "send" && element.kind !== "jump") || index === path.length - 1;
  });
