/** An operator panel: elements on a grid, and how they are changed. Each change makes a new panel, so that it can be undone and
 * merged. The text of a panel is a file of the project, `NAME.panel.json`. */

export const KINDS = ["switch", "button", "lamp", "number", "slider", "bar", "trend", "text"] as const;
export type Kind = (typeof KINDS)[number];

/** What it means that a lamp is on, or a button pressed: as the colours of IEC 60073 do. */
export const TONES = ["normal", "neutral", "warning", "fault"] as const;
type Tone = (typeof TONES)[number];

/** Cells of the grid, counted from 0 at the top left. */
interface Place {
  column: number;
  row: number;
  width: number;
  height: number;
}

export interface PanelElement extends Place {
  id: string;
  kind: Kind;
  /** The variable or address; empty for a text without a value. */
  path: string;
  /** Empty: the name of the variable. */
  label: string;
  /** The ends of the scale of a slider, a bar and a trend. */
  low: number;
  high: number;
  /** Not there: normal. */
  tone?: Tone | undefined;
}

export interface Panel {
  elements: readonly PanelElement[];
}

export const EMPTY_PANEL: Panel = { elements: [] };
const COLUMNS = 60;
const ROWS = 200;
const MOST_ELEMENTS = 500;
/** Characters of a path and of a label. */
const LONGEST = 500;
const VERSION = 1;

/** The size of a new element, and the smallest one. */
export const SIZES: Record<Kind, readonly [width: number, height: number, least: number, low: number]> = {
  switch: [4, 2, 3, 2],
  button: [4, 2, 2, 2],
  lamp: [4, 2, 2, 2],
  number: [5, 2, 3, 2],
  slider: [7, 2, 4, 2],
  bar: [3, 5, 2, 3],
  trend: [9, 5, 5, 3],
  text: [5, 1, 2, 1],
};

/** Kinds that write the variable. */
export const WRITES: readonly Kind[] = ["switch", "button", "number", "slider"];
/** Kinds whose light has a meaning. */
export const TONED: readonly Kind[] = ["lamp", "button"];
/** Kinds that have a scale. */
export const SCALED: readonly Kind[] = ["slider", "bar", "trend"];

// ---- text -------------------------------------------------------------------------------------------------------------

/** One element a line, so that versions of the file can be compared. */
export function textOf({ elements }: Panel): string {
  const lines = elements.map((element) => `    ${JSON.stringify(element)}`);
  return `{\n  "version": ${VERSION},\n  "elements": [${lines.length > 0 ? `\n${lines.join(",\n")}\n  ` : ""}]\n}\n`;
}

/** What is wrong with a text: `at` is the number of the element, from 1. */
export interface Wrong {
  why: "json" | "version" | "elements" | "element" | "many";
  at: number;
}

/** The panel of a text. What a newer version may have besides is left out. */
export function parsePanel(text: string): Panel | Wrong {
  let read: unknown;
  try {
    read = JSON.parse(text);
  } catch {
    return { why: "json", at: 0 };
  }
  const { version, elements } = (read ?? {}) as { version?: unknown; elements?: unknown };
  if (version !== VERSION) return { why: "version", at: 0 };
  if (!Array.isArray(elements)) return { why: "elements", at: 0 };
  if (elements.length > MOST_ELEMENTS) return { why: "many", at: MOST_ELEMENTS };
  const found: PanelElement[] = [];
  for (const [index, each] of elements.entries()) {
    const element = elementOf(each);
    if (element === null || found.some(({ id }) => id === element.id)) return { why: "element", at: index + 1 };
    found.push(element);
  }
  return { elements: found };
}

function elementOf(read: unknown): PanelElement | null {
  if (typeof read !== "object" || read === null) return null;
  const {
    id,
    kind,
    path = "",
    label = "",
    low = 0,
    high = 100,
    column,
    row,
    width,
    height,
    tone,
  } = read as Partial<PanelElement>;
  const texts = [id, path, label].every((each) => typeof each === "string");
  const numbers = [low, high, column, row, width, height].every((each) => Number.isFinite(each));
  if (!texts || !numbers || id === "" || !KINDS.some((known) => known === kind)) return null;
  const element = { id, kind, path, label, low, high, column, row, width, height } as PanelElement;
  const known = TONES.find((each) => each === tone);
  if (known !== undefined && known !== "normal") element.tone = known;
  return fitting(element);
}

/** The element as it can be read again: its texts are not too long, and it is on the grid. */
const fitting = (element: PanelElement): PanelElement => ({
  ...element,
  path: element.path.slice(0, LONGEST),
  label: element.label.slice(0, LONGEST),
  ...inside(element.kind, element),
});

// ---- places -----------------------------------------------------------------------------------------------------------

const between = (low: number, value: number, high: number) => Math.max(low, Math.min(high, Math.round(value)));

/** The nearest place on the grid that an element of a kind can have. */
function inside(kind: Kind, { column, row, width, height }: Place): Place {
  const [, , leastWidth, leastHeight] = SIZES[kind];
  const wide = between(leastWidth, width, COLUMNS);
  const high = between(leastHeight, height, ROWS);
  return { column: between(0, column, COLUMNS - wide), row: between(0, row, ROWS - high), width: wide, height: high };
}

const overlap = (one: Place, other: Place) =>
  one.column < other.column + other.width &&
  other.column < one.column + one.width &&
  one.row < other.row + other.height &&
  other.row < one.row + one.height;

/** The first free place, from the top left, in a panel so many columns wide. */
function freePlace(panel: Panel, kind: Kind, columns: number): Place {
  const [width, height] = SIZES[kind];
  for (let row = 0; row <= ROWS - height; row += 1) {
    for (let column = 0; column <= Math.max(0, columns - width); column += 1) {
      const place = { column, row, width, height };
      if (!panel.elements.some((element) => overlap(element, place))) return place;
    }
  }
  return { column: 0, row: 0, width, height };
}

/** How many columns and rows the elements take. */
export function extent({ elements }: Panel): { columns: number; rows: number } {
  return {
    columns: Math.max(0, ...elements.map(({ column, width }) => column + width)),
    rows: Math.max(0, ...elements.map(({ row, height }) => row + height)),
  };
}

// ---- changes ----------------------------------------------------------------------------------------------------------

/** A page that was not loaded by https has no `randomUUID`. */
export const newId = () =>
  [...crypto.getRandomValues(new Uint8Array(6))].map((byte) => byte.toString(16).padStart(2, "0")).join("");

interface NewElement {
  id: string;
  kind: Kind;
  path?: string;
  label?: string;
  /** The cell of its top left corner; else the first free place. */
  at?: { column: number; row: number } | null;
}

/** Adds an element, where it is seen in a panel that is shown so many columns wide. */
export function addElement(panel: Panel, { id, kind, path = "", label = "", at }: NewElement, columns: number): Panel {
  if (panel.elements.length >= MOST_ELEMENTS) return panel;
  const [width, height] = SIZES[kind];
  const place = at ? inside(kind, { ...at, width, height }) : freePlace(panel, kind, columns);
  return { elements: [...panel.elements, fitting({ id, kind, path, label, low: 0, high: 100, ...place })] };
}

/** Changes an element: its place stays on the grid. */
export function changeElement(panel: Panel, id: string, change: Partial<Omit<PanelElement, "id">>): Panel {
  const elements = panel.elements.map((element) => {
    if (element.id !== id) return element;
    return fitting({ ...element, ...change });
  });
  return { elements };
}

export const removeElement = ({ elements }: Panel, id: string): Panel => ({
  elements: elements.filter((element) => element.id !== id),
});

export const samePanel = (one: Panel, other: Panel) => textOf(one) === textOf(other);

/** Two people changed `base`: what either of them added, removed or changed; of two changes to one element, mine. */
export function mergePanels(base: Panel, mine: Panel, theirs: Panel): Panel {
  const [before, own, other] = [byId(base), byId(mine), byId(theirs)];
  const kept = theirs.elements.flatMap((element) => {
    const ours = own.get(element.id);
    if (ours === undefined) return before.has(element.id) ? [] : element; // I removed it, or they added it
    return same(ours, before.get(element.id)) ? element : ours;
  });
  const added = mine.elements.filter(({ id }) => !other.has(id) && !same(own.get(id), before.get(id)));
  return { elements: [...kept, ...added].slice(0, MOST_ELEMENTS) };
}

const byId = ({ elements }: Panel) => new Map(elements.map((element) => [element.id, element]));
const same = (one: PanelElement | undefined, other: PanelElement | undefined) =>
  JSON.stringify(one) === JSON.stringify(other);

/** The kind that suits a variable of this type: what a program writes is shown, what it reads is operated. */
export function kindFor(type: string, output: boolean): Kind {
  if (type === "BOOL") return output ? "lamp" : "switch";
  if (/STRING|CHAR/.test(type)) return "text";
  return "number";
}
