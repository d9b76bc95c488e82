/** The drawing of a file on paper: all of its parts, each whole on a page where there is room, without values. */

import { useEffect, useRef } from "react";
import type { DrawnPart } from "../../../../logic/graphic/sheet";
import { bare, withPictures } from "./svgFile";
import "./printed.css";

/** What has room between the margins of a page of A4, in pixels. */
export const PAPER = 690;
const HIGH = 960;
const LEAST = 0.55;

/** Puts the drawing where the browser prints it instead of the page. What is returned takes it away again. */
export function layOnPaper(
  title: string,
  parts: readonly DrawnPart[],
  headOf: (part: DrawnPart) => string,
): () => void {
  const paper = element("div", "printed");
  paper.dataset.theme = "light";
  paper.append(element("h1", "", title));
  withPictures(parts, (pictures) => {
    parts.forEach((part, index) => {
      const section = element("section", "");
      const { comment, off } = part.found.head;
      const head = element("header", "");
      head.append(element("h2", "", headOf(part)));
      for (const line of [...comment, ...(off ? ["{off}"] : [])]) head.append(element("p", "", line));
      section.append(head);
      const picture = pictures.children[index]?.querySelector("svg");
      if (picture) section.append(...piecesOf(picture));
      else section.append(element("pre", "", part.found.text));
      paper.append(section);
    });
  });
  document.body.append(paper);
  document.documentElement.classList.add("printing");
  return () => {
    paper.remove();
    if (!document.querySelector(".printed")) document.documentElement.classList.remove("printing");
  };
}

/** Has something printed instead of the page: `put` puts it there, and gives what takes it away again. */
export function usePrinted(put: () => (() => void) | null): void {
  const latest = useRef(put);
  useEffect(() => {
    latest.current = put;
  });
  useEffect(() => {
    let clear: (() => void) | null = null;
    const after = () => {
      clear?.();
      clear = null;
    };
    const before = () => {
      after();
      clear = latest.current();
    };
    addEventListener("beforeprint", before);
    addEventListener("afterprint", after);
    return () => {
      after();
      removeEventListener("beforeprint", before);
      removeEventListener("afterprint", after);
    };
  }, []);
}

/** A picture as wide as the paper at most; one that would be too small or is too high, in several pieces. */
function piecesOf(picture: SVGSVGElement): SVGSVGElement[] {
  const [width, height] = [Number(picture.getAttribute("width")), Number(picture.getAttribute("height"))];
  const scale = Math.min(1, Math.max(LEAST, PAPER / width));
  const [wide, high] = [PAPER / scale, HIGH / scale];
  const pieces: SVGSVGElement[] = [];
  for (let y = 0; y < height; y += high)
    for (let x = 0; x < width; x += wide) {
      const [w, h] = [Math.min(wide, width - x), Math.min(high, height - y)];
      const piece = bare(picture);
      piece.setAttribute("viewBox", `${x} ${y} ${w} ${h}`);
      piece.setAttribute("width", String(w * scale));
      piece.setAttribute("height", String(h * scale));
      pieces.push(piece);
    }
  return pieces;
}

function element<Name extends keyof HTMLElementTagNameMap>(
  name: Name,
  look: string,
  text = "",
): HTMLElementTagNameMap[Name] {
  const made = document.createElement(name);
  made.className = look;
  made.textContent = text;
  return made;
}
