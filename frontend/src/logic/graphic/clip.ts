/** Elements and whole networks as the text that is copied, and what such a text is where it is put in. */

import { chartEdit } from "./chartKeys";
import { partsPut } from "./chartMove";
import { readChart } from "./charts";
import { at, diagramOf, lineAfter } from "./diagramEdit";
import { readDiagram } from "./diagramRead";
import { type Around, changed, type Edit, type Made, newName, type Refused } from "./edit";
import { elementAt, insert } from "./ladderEdit";
import type { Place } from "./ladderLayout";
import { readRung } from "./ladderRead";
import { writeRung } from "./ladderWrite";
import { type Found, networksIn } from "./networks";
import { type DrawnPart, spotsOf } from "./sheet";

const UNFIT: Refused = { refused: "graphic.refused.paste" };

/** A network with its pragma, its first line without the blanks before it. */
export const wholeText = ({ text, indent, head }: Found) =>
  (head.off ? "{off} " : "") +
  text
    .split("\n")
    .map((line) => (line.startsWith(indent) ? line.slice(indent.length) : line))
    .join("\n");

/** The text of the element at a place, of a pin that of its line; without one that of the network or chart. */
export function copied(part: DrawnPart, place: Place): string | null {
  const { text } = part.found;
  if (!part.readable) return part.kind === "chart" ? text : wholeText(part.found);
  if (part.kind === "rung") {
    const element = part.path && elementAt(part.path, place);
    return element ? text.slice(element.span.at, element.span.end) : wholeText(part.found);
  }
  const span = spotsOf(part).find((each) => each.place[0] === place[0])?.element.span;
  if (part.kind === "chart") return text.slice(span?.at, span?.end);
  return span ? `${text.slice(span.at, span.end)};` : wholeText(part.found);
}

/** The networks that a text consists of, each as it is put in; null where it has anything else, or one that cannot be read. */
export function networksOf(text: string): readonly string[] | null {
  const written = text.replace(/\r\n?/g, "\n");
  const found = networksIn(written);
  let rest = written;
  for (const { from, to } of [...found].reverse()) rest = rest.slice(0, from) + rest.slice(to);
  const readable = found.every((each) => (each.kind === "rung" ? readRung(each) : readDiagram(each)).kind !== "unread");
  const only = rest.replace(/\{off\}/gi, "").trim() === "" && found.every(({ closed }) => closed);
  return found.length > 0 && readable && only ? found.map(wholeText) : null;
}

/** The part with the elements of a text after the cursor; refused where the text is none that fits. */
export function pasted(part: DrawnPart, place: Place, text: string, around: Around): Made {
  if (!part.readable) return { refused: "graphic.refused.unread" };
  if (part.kind === "chart") return intoChart(part.found, place, text.trim(), around);
  if (part.kind === "network") return intoNetwork(part.found.text, place, text, around);
  if (part.comments) return { refused: "graphic.comments" };
  const [found] = networksIn(`RUNG\n${text}\nEND_RUNG\n`);
  const read = found?.closed ? readRung(found) : null;
  if (read?.kind !== "rung" || read.comments || read.path.length === 0) return UNFIT;
  // Of several texts like `END_RUNG RUNG` only the first would be read.
  if (found && found.to < `RUNG\n${text}\nEND_RUNG`.length) return UNFIT;
  const there = place.length % 2 === 0 || elementAt(part.path ?? [], place) ? place : [];
  let made = { path: part.path ?? [], place: there };
  for (const element of read.path) made = insert(made.path, made.place, element);
  return { text: writeRung(part.found.head, made.path, part.found.indent), place: made.place, naming: null };
}

/** Lines after the line at the cursor. A wire that is set on both sides gets a different name in what is put in. */
function intoNetwork(whole: string, place: Place, text: string, around: Around): Made {
  const diagram = diagramOf(whole);
  const source = `NETWORK\n${text}\nEND_NETWORK`;
  const read = diagramOf(source);
  if (!diagram || !read || read.items.length === 0 || networksIn(source)[0]?.to !== source.length) return UNFIT;
  const set = new Set(diagram.items.flatMap(({ outputs }) => outputs.flatMap(({ wire }) => wire ?? [])));
  const names = new Set(around.names);
  const renamed = new Map<string, string>();
  for (const { wire } of read.items.flatMap(({ outputs }) => outputs)) {
    if (wire === null || !set.has(wire) || renamed.has(wire)) continue;
    const name = newName(wire.replace(/\d+$/, "").toLowerCase(), names);
    names.add(name.toUpperCase());
    renamed.set(wire, name);
  }
  const lines = read.items.map(({ span }) =>
    read.text
      .slice(span.at, span.end)
      .replace(/#[\p{L}_][\p{L}\p{N}_]*/gu, (wire) => renamed.get(wire.toUpperCase()) ?? wire),
  );
  const index = at(diagram, place)?.index ?? diagram.items.length - 1;
  const put = lineAfter(diagram, index, lines[0] ?? "");
  const more = lines.slice(1).map((line) => lineAfter(diagram, index, line).text);
  const made = changed(whole, [{ ...put, text: put.text + more.join("") }]);
  return { text: made, place: [index + lines.length], naming: null };
}

/** An action into the step at the cursor, or a step after it, with a new name where there is one of its name. */
function intoChart(found: Found, place: Place, text: string, around: Around): Made {
  const read = readChart({ ...found, text, closed: true });
  const [step, ...others] = read.kind === "chart" ? read.steps : [];
  if (read.kind === "chart" && (others.length > 0 || read.transitions.length > 0 || read.bodies.length > 0))
    return partsPut(found, place, text, around) ?? UNFIT;
  const taken = (key: string, typed: string): Edit | null => {
    const made = chartEdit(found, key, place, around);
    return made && "naming" in made ? (made.naming?.taken(typed, around) ?? null) : null;
  };
  if (!step) return actionsPut(found, place, text, around) ?? UNFIT;
  const name = around.names.has(step.name.toUpperCase())
    ? newName(step.name.replace(/\d+$/, ""), around.names)
    : step.name;
  const made = taken("s", name);
  if (!made) return UNFIT;
  const body = text.slice(step.named.end, step.span.end);
  return { ...made, text: made.text.replace(new RegExp(`\\bSTEP ${name}:\\s*END_STEP`), () => `STEP ${name}${body}`) };
}

/** Actions into the step at the cursor, one a line; null where one of them does not fit there. */
function actionsPut(found: Found, place: Place, text: string, around: Around): Edit | null {
  let made: Edit | null = null;
  for (const line of text.split("\n")) {
    const now = made === null ? found : { ...found, text: made.text, body: { at: 0, end: made.text.length } };
    const edit = chartEdit(now, "a", made?.place ?? place, around);
    made = edit && "naming" in edit ? (edit.naming?.taken(line.trim().replace(/;$/, ""), around) ?? null) : null;
    if (made === null) return null;
  }
  return made;
}
