/** The rungs of a text as they are drawn. What did not change is not laid out again. */

import { type Drawing, layOut } from "./ladderLayout";
import { readRung } from "./ladderRead";
import { type Found, networksIn } from "./networks";
import type { Path } from "./tree";

export interface DrawnRung {
  found: Found;
  /** Null while the text cannot be read: then `drawing` is the last one of this rung, if there was any. */
  path: Path | null;
  /** Comments are between its elements, which the drawing does not have: only its text can be edited. */
  comments: boolean;
  drawing: Drawing | null;
}

const HEAD = 28;
const PLAIN_LINE = 18;

/** How high a rung is with its head, in pixels. */
export function heightOf({ found, path, drawing }: DrawnRung): number {
  const drawn = drawing?.height ?? 0;
  return HEAD + drawn + (path === null ? PLAIN_LINE * found.text.split("\n").length + 12 : 0);
}

/** Draws texts of one file, one after the other. */
export class Rungs {
  private known = new Map<string, DrawnRung>();
  private drawn: readonly DrawnRung[] = [];
  private width = 0;

  of(text: string, width: number): readonly DrawnRung[] {
    const before = this.width === width ? this.known : new Map<string, DrawnRung>();
    const last = this.drawn;
    this.width = width;
    this.known = new Map();
    this.drawn = networksIn(text).map((found, index) => {
      const same = before.get(found.text);
      const rung = same ? { ...same, found } : draw(found, width, last[index]?.drawing ?? null);
      this.known.set(found.text, rung);
      return rung;
    });
    return this.drawn;
  }
}

function draw(found: Found, width: number, last: Drawing | null): DrawnRung {
  const read = found.closed ? readRung(found) : null;
  if (read === null || read.kind === "unread") return { found, path: null, comments: false, drawing: last };
  return { found, path: read.path, comments: read.comments, drawing: layOut(read.path, width) };
}
