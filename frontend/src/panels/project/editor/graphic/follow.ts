/** Values of variables as they are written in a POU, followed for a drawing: twenty times a second React would draw it again. */

import type { PartFlow } from "../../../../logic/graphic/flow";
import { pathOf } from "../../../../store/debug/seenAs";
import { bindCell } from "../../../../store/plc/values";
import { watch } from "../../../../store/plc/watches";
import { forcedAt } from "../../../../store/watch/forces";
import type { Pou } from "../../../../wire/types";

/** A variable as it may be written: `s[2].ready`. An expression is none. */
const VARIABLE = /^[\p{L}_%][\p{L}\p{N}_.]*(?:\[[\p{N}\s,-]+\][\p{L}\p{N}_.]*)*$/u;

export interface Values {
  /** The text of a value; null where it is not known. */
  text: (variable: string) => string | null;
  /** The value of a BOOL; null where it is none, or not known. */
  truth: (variable: string) => boolean | null;
  forced: (variable: string) => boolean;
}

const truthOf = (text: string | null) => (text === "TRUE" ? true : text === "FALSE" ? false : null);

/** A drawing that shows what is live. */
export interface Shown {
  stop: () => void;
  /** What the code saw, or null where only values tell. */
  onFlow: (flow: PartFlow | null) => void;
}

const LIVE = ["on", "unsure", "closes", "enabled", "known", "forced", "stale", "idle"];

/** Takes out of a drawing what was live in it: a drawing that is not followed any more must not look as if it were. */
export function clear(svg: SVGSVGElement): void {
  for (const each of svg.querySelectorAll(LIVE.map((name) => `.${name}`).join())) each.classList.remove(...LIVE);
  for (const each of svg.querySelectorAll("[data-live], [data-value], [data-wirevalue], [data-seen]"))
    each.textContent = "";
}

/** Calls `paint` now and with each change, at most once a frame, until the returned function is called. */
export function follow(pou: Pou, variables: Iterable<string>, paint: (values: Values) => void): () => void {
  const paths = new Map<string, string>();
  for (const variable of variables) {
    const path = VARIABLE.test(variable) ? pathOf(pou, variable) : undefined;
    if (path !== undefined) paths.set(variable, path);
  }
  const known = new Map<string, string>();
  const text = (variable: string) => known.get(variable) ?? null;
  const values: Values = {
    text,
    truth: (variable) => truthOf(text(variable)),
    forced: (variable) => {
      const path = paths.get(variable);
      return path !== undefined && forcedAt(path) !== undefined;
    },
  };
  let due = 0;
  const now = () => {
    due = 0;
    paint(values);
  };
  const unwatch = watch([...paths.values()]);
  const unbind = [...paths].map(([variable, path]) =>
    bindCell(path, "default", (reading) => {
      if (reading.text === "") known.delete(variable);
      else known.set(variable, reading.text);
      due ||= requestAnimationFrame(now);
    }),
  );
  // What the cells had at once is painted now, not once more in the next frame.
  cancelAnimationFrame(due);
  now();
  return () => {
    cancelAnimationFrame(due);
    for (const each of unbind) each();
    unwatch();
  };
}

/** Calls `paint` with the values and with what the code saw, where that is known, whenever one of them changes. */
export function showWith(
  pou: Pou,
  variables: Iterable<string>,
  paint: (values: Values, flow: PartFlow | null) => void,
): Shown {
  let flow: PartFlow | null = null;
  let values: Values | null = null;
  const show = () => values && paint(values, flow);
  const stop = follow(pou, variables, (now) => {
    values = now;
    show();
  });
  return {
    stop,
    onFlow: (found) => {
      flow = found;
      show();
    },
  };
}
