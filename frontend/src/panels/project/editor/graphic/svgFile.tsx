/** The drawing of a file as one SVG with everything in it: no values, no marks, the colours of the light theme, for paper. */

import { flushSync } from "react-dom";
import { createRoot } from "react-dom/client";
import type { DrawnPart } from "../../../../logic/graphic/sheet";
import { ChartPicture } from "./ChartPicture";
import { DiagramPicture } from "./DiagramPicture";
import { RungDrawing } from "./RungDrawing";
import type { Marked } from "./SpotGroup";

const SVG = "http://www.w3.org/2000/svg";
const MARGIN = 16;
const HEAD = 26;
const LINE = 16;
const PLAIN: Marked = { id: "", cursor: null, next: "", points: "", chosen: "", wrong: "", apart: "", target: "" };

/** `headOf` gives the headline of a part. */
export const svgFile = (parts: readonly DrawnPart[], headOf: (part: DrawnPart) => string): string =>
  withPictures(parts, (paper) => whole(paper, parts, headOf));

/** What `use` makes of an element that has the picture of each part in an element of its own, in the colours of the light theme. */
export function withPictures<T>(parts: readonly DrawnPart[], use: (paper: HTMLElement) => T): T {
  const paper = document.createElement("div");
  // Colours are those of this element, whatever the theme of the page is.
  paper.dataset.theme = "light";
  paper.hidden = true;
  document.body.append(paper);
  const root = createRoot(paper);
  try {
    flushSync(() => root.render(parts.map((part) => <div key={part.found.from}>{pictureOf(part)}</div>)));
    return use(paper);
  } finally {
    root.unmount();
    paper.remove();
  }
}

/** While the text of a part cannot be read there is only its text. */
function pictureOf(part: DrawnPart) {
  if (!part.readable || !part.drawing) return null;
  if (part.kind === "rung") return <RungDrawing drawing={part.drawing} {...PLAIN} />;
  if (part.kind === "network") return <DiagramPicture drawing={part.drawing} {...PLAIN} />;
  return <ChartPicture drawing={part.drawing} {...PLAIN} />;
}

function whole(paper: HTMLElement, parts: readonly DrawnPart[], headOf: (part: DrawnPart) => string): string {
  const file = document.createElementNS(SVG, "svg");
  const look = getComputedStyle(paper);
  const ground = element("rect", {
    width: "100%",
    height: "100%",
    fill: look.getPropertyValue("--bg-panel").trim() || "white",
  });
  const style = element("style", {});
  style.textContent = rules(look);
  file.append(style, ground);
  let [width, y] = [400, MARGIN];
  parts.forEach((part, index) => {
    const { comment, off } = part.found.head;
    const lines = [...comment, ...(off ? ["{off}"] : [])];
    const picture = paper.children[index]?.querySelector("svg");
    file.append(textAt(headOf(part), "head", y + 14));
    y += HEAD;
    const plain = picture ? [] : part.found.text.split("\n");
    for (const line of [...lines, ...plain]) {
      file.append(textAt(line, lines.includes(line) ? "note" : "plain", y + 10));
      y += LINE;
    }
    if (picture) {
      const copy = bare(picture);
      copy.setAttribute("x", String(MARGIN));
      copy.setAttribute("y", String(y));
      file.append(copy);
      width = Math.max(width, Number(picture.getAttribute("width")));
      y += Number(picture.getAttribute("height"));
    }
    y += MARGIN;
  });
  file.setAttribute("class", "draw");
  for (const [name, value] of [
    ["width", width + 2 * MARGIN],
    ["height", y],
  ] as const)
    file.setAttribute(name, String(value));
  file.setAttribute("viewBox", `0 0 ${width + 2 * MARGIN} ${y}`);
  return `<?xml version="1.0" encoding="UTF-8"?>\n${new XMLSerializer().serializeToString(file)}\n`;
}

function element(name: string, attributes: Readonly<Record<string, string>>): SVGElement {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  return made;
}

function textAt(text: string, look: string, y: number): SVGElement {
  const made = element("text", { class: look, x: String(MARGIN), y: String(y), "xml:space": "preserve" });
  made.textContent = text;
  return made;
}

/** A picture without what is there for the pointer and for readers of the screen. */
export function bare(picture: SVGSVGElement): SVGSVGElement {
  const copy = picture.cloneNode(true) as SVGSVGElement;
  for (const each of copy.querySelectorAll(".hit, .pad, [data-live], .vl")) each.remove();
  for (const each of [copy, ...copy.querySelectorAll("*")])
    for (const { name } of [...each.attributes])
      if (name === "role" || name === "id" || name.startsWith("aria-") || name.startsWith("data-"))
        each.removeAttribute(name);
  return copy;
}

const OWN = [
  ".draw .head { font: 600 13px var(--font-ui); fill: var(--text); }",
  ".draw .note { font: 12px var(--font-ui); fill: var(--code-comment); }",
  ".draw .plain { font: 12px var(--font-mono); fill: var(--code-text); }",
];

/** The rules of the page that look after drawings, with the values of its variables in them. */
function rules(look: CSSStyleDeclaration): string {
  const found = [...document.styleSheets].flatMap((sheet) =>
    [...sheet.cssRules].flatMap((rule) =>
      rule instanceof CSSStyleRule && /^(?:svg)?\.draw\b/.test(rule.selectorText) ? [rule.cssText] : [],
    ),
  );
  return [...found, ...OWN]
    .join("\n")
    .replace(/var\((--[\w-]+)\)/g, (_whole, name: string) => look.getPropertyValue(name).trim() || "inherit");
}
