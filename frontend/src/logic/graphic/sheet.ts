/** The rungs, function block diagrams and charts of a text as they are drawn. What did not change is not laid out again. */

import { type Chart, keyOf } from "./chart";
import { type ChartDrawing, layOutChart } from "./chartLayout";
import { partsIn, readChart } from "./charts";
import { type DiagramDrawing, layOutDiagram } from "./diagramLayout";
import { pinsOf } from "./diagramPins";
import { readDiagram } from "./diagramRead";
import { type Heading, headingOf } from "./heading";
import { InstanceTypes, type TypeOf, UNKNOWN } from "./instanceTypes";
import { type Drawing, layOut, type Place } from "./ladderLayout";
import { readRung } from "./ladderRead";
import { type Found, networksIn } from "./networks";
import type { Path, Span } from "./tree";

interface Drawn<Kind, Picture> {
  kind: Kind;
  found: Found;
  /** While the text cannot be read `drawing` is the last one of this part, if there was any. */
  readable: boolean;
  drawing: Picture | null;
}

export interface DrawnRung extends Drawn<"rung", Drawing> {
  /** Null where the text cannot be read. */
  path: Path | null;
  /** Of the instances that its boxes call. */
  typeOf: TypeOf;
  /** Comments are between its elements, which the drawing does not have: only its text can be edited. */
  comments: boolean;
}

interface DrawnChart extends Drawn<"chart", ChartDrawing> {
  /** Where the statements of its actions are written. */
  bodies: Chart["bodies"];
}

type DrawnNetwork = Drawn<"network", DiagramDrawing>;

export type DrawnPart = DrawnRung | DrawnNetwork | DrawnChart;

/** What a cursor can be at: an element and its place in the drawing. */
export interface Spot {
  place: Place;
  /** The left end, and the height of its middle or of its wire. */
  x: number;
  y: number;
  width: number;
  /** The line that it is on, where that is not in its middle. */
  axis?: number;
  element: { kind: string; span: Span };
}

export const spotsOf = (part: DrawnPart | undefined): readonly Spot[] => part?.drawing?.elements ?? [];

/** Where a cursor can be: at elements, at the pins of a network, and where the branches of a rung join. */
export function stopsOf(part: DrawnPart | undefined): readonly Spot[] {
  if (part?.kind === "network" && part.drawing) return [...part.drawing.elements, ...pinsOf(part.drawing)];
  if (part?.kind === "rung" && part.drawing) return [...part.drawing.elements, ...part.drawing.gaps];
  return spotsOf(part);
}

/** How far from a wire a click means it. */
const NEAR = 10;

/** The place on the wire of a rung at a point of its drawing: what is put in comes there. Null where there is no wire. */
export function placeOnWire(part: DrawnPart, x: number, y: number): Place | null {
  if (part.kind !== "rung" || !part.drawing) return null;
  const row = stopsOf(part).filter((each) => Math.abs(each.y - y) <= NEAR);
  const left = row.filter((each) => each.x + each.width / 2 <= x).sort((a, b) => b.x - a.x)[0];
  if (left) return left.place;
  const first = row.sort((a, b) => a.x - b.x)[0]?.place;
  if (first) return first.length % 2 === 0 ? first : first.slice(0, -1);
  return part.path?.length === 0 ? [] : null;
}

/** The charts of each file that was drawn: in a file with many rungs this is asked for each of them. */
const charts = new WeakMap<readonly DrawnPart[], readonly DrawnChart[]>();

function chartsOf(parts: readonly DrawnPart[]): readonly DrawnChart[] {
  const known = charts.get(parts);
  if (known) return known;
  const found = parts.filter((part) => part.kind === "chart");
  charts.set(parts, found);
  return found;
}

/** The action of a chart that a rung or network is written in, and the chart; null elsewhere. */
export function actionOf(parts: readonly DrawnPart[], { found }: DrawnPart): { name: string; chart: DrawnPart } | null {
  for (const chart of chartsOf(parts)) {
    const at = found.from - chart.found.from;
    const body = chart.bodies.find(({ span }) => at >= span.at && at < span.end);
    if (body) return { name: body.name, chart };
  }
  return null;
}

/** The place of a step of a chart. */
export function stepIn(part: DrawnPart | undefined, name: string): Place | undefined {
  if (part?.kind !== "chart") return undefined;
  const found = part.drawing?.elements.find(
    ({ element }) => element.kind === "step" && keyOf(element.name) === keyOf(name),
  );
  return found?.place;
}

/** The lines above a part in this width: the action it is written in, its label, title and comment. */
export function headOf(
  { found: { head }, drawing, readable }: DrawnPart,
  width: number,
  action: string | null,
): Heading {
  const before = [action ?? "", head.label && `${head.label}:`].filter(Boolean).join("  ");
  const known = drawing && readable ? headings.get(drawing) : undefined;
  if (known?.width === width && known.before === before) return known.heading;
  const heading = headingOf(head.title, head.comment, width, before);
  if (drawing && readable) headings.set(drawing, { width, before, heading });
  return heading;
}

/** By drawing: a text that is read has its own, so its title is the same as long as that is. */
const headings = new WeakMap<object, { width: number; before: string; heading: Heading }>();

const LEAST_SCALE = 0.5;

/** How large a drawing is that is made to fit into a width: its texts have to stay readable, so it may still be wider. */
export const scaleOf = ({ drawing }: DrawnPart, width: number): number =>
  drawing ? Math.min(1, Math.max(LEAST_SCALE, Math.floor((width / drawing.width) * 100) / 100)) : 1;

const PLAIN_LINE = 18;

/** How high a part is with its head, in pixels. */
export function heightOf(part: DrawnPart, head: number, scale = 1): number {
  const { found, readable, drawing } = part;
  const plain = readable ? 0 : PLAIN_LINE * found.text.split("\n").length + 12;
  return head + Math.ceil((drawing?.height ?? 0) * scale) + plain;
}

/** Draws texts of one file, one after the other. */
export class Sheet {
  private known = new Map<string, DrawnPart>();
  private drawn: readonly DrawnPart[] = [];
  private width = 0;

  of(text: string, width: number): readonly DrawnPart[] {
    const before = this.known;
    const wider = this.width !== width;
    const last = this.drawn;
    this.width = width;
    this.known = new Map();
    const types = new InstanceTypes(text);
    this.drawn = partsIn(text).map((found, index) => {
      const key = found.kind === "rung" ? `${types.key}\n${found.text}` : found.text;
      const same = before.get(key);
      const part = same
        ? { ...(wider ? inWidth(same, width) : same), found }
        : draw(found, width, last[index], types.at(found.from));
      this.known.set(key, part);
      return part;
    });
    return this.drawn;
  }
}

/** The same in a different width: a rung reaches from rail to rail, others do not ask for it. */
function inWidth(part: DrawnPart, width: number): DrawnPart {
  return part.kind === "rung" && part.path ? { ...part, drawing: layOut(part.path, width, part.typeOf) } : part;
}

function draw(found: Found, width: number, last: DrawnPart | undefined, typeOf: TypeOf): DrawnPart {
  if (found.kind === "chart") {
    const read = readChart(found);
    if (read.kind === "chart")
      return { kind: "chart", found, readable: true, bodies: read.bodies, drawing: layOutChart(read) };
    const drawing = last?.kind === "chart" ? last.drawing : null;
    return { kind: "chart", found, readable: false, bodies: [], drawing };
  }
  if (found.kind === "network") {
    const read = readDiagram(found);
    const drawing =
      read.kind === "network" ? layOutDiagram(read.items) : last?.kind === "network" ? last.drawing : null;
    return { kind: "network", found, readable: read.kind === "network", drawing };
  }
  const read = found.closed ? readRung(found) : null;
  if (read?.kind === "rung")
    return {
      ...{ kind: "rung", found, readable: true, path: read.path, comments: read.comments, typeOf },
      drawing: layOut(read.path, width, typeOf),
    };
  const drawing = last?.kind === "rung" ? last.drawing : null;
  return { kind: "rung", found, readable: false, path: null, comments: false, typeOf, drawing };
}

/** A part with a different text, as it is drawn while that is not written yet. */
export function drawnWith(part: DrawnPart, text: string, width: number): DrawnPart {
  const [network] = part.kind === "chart" ? [] : networksIn(text);
  const body = network?.body ?? { at: 0, end: text.length };
  const typeOf = part.kind === "rung" ? part.typeOf : UNKNOWN;
  const drawn = draw({ ...part.found, text, body, closed: network?.closed ?? true }, width, part, typeOf);
  return { ...drawn, found: part.found };
}
