import type { ReactNode } from "react";
import type { Place } from "../../../../logic/graphic/ladderLayout";
import { t } from "../../../../text";

/** Lines of one pixel are sharp in the middle of a pixel. */
export const sharp = (value: number) => Math.round(value) + 0.5;

/** What is marked in a drawing. */
export interface Marked {
  id: string;
  /** The place of the cursor, joined by points; null where it is elsewhere. */
  cursor: string | null;
  /** The element at which the program is halted, and those with breakpoints: see `PartMarks`. */
  next: string;
  points: string;
  /** The places of elements that are chosen together, each joined by points. */
  chosen: string;
  /** Elements that are wrong, one a line, each with what the compiler says: see `wrongText`. */
  wrong: string;
  /** Wires that are not the same on both sides of a verification: see `AllApart`. */
  apart: string;
  /** The place that a drop means; empty where nothing is dragged. */
  target: string;
}

interface Props extends Marked {
  place: Place;
  name: string;
  kind?: string;
  box: { x: number; y: number; width: number; height: number };
  /** Where its breakpoint is drawn. */
  dot: { x: number; y: number };
  children: ReactNode;
}

/** An element of a drawing, with the frame of the cursor and of a halt, and its breakpoint. */
export function SpotGroup({ place, name, kind = "", box, dot, children, ...marked }: Props) {
  const key = place.join(".");
  const selected = marked.chosen === "" ? key === marked.cursor : isChosen(marked.chosen, key);
  const halted = key === marked.next;
  const point = pointsIn(marked.points).get(key);
  const wrong = wrongAt(marked.wrong, key);
  return (
    <g
      id={`${marked.id}-${key}`}
      // Classes are what is live: to select an element must not take them away.
      className={`el ${kind}`}
      data-wrong={wrong === "" ? undefined : ""}
      data-next={halted || undefined}
      data-drop={(marked.target !== "" && key === marked.target) || undefined}
      role="option"
      aria-selected={selected}
      aria-label={[name, halted && t("graphic.next"), point && t("graphic.point"), wrong].filter(Boolean).join(", ")}
      data-element={key}
    >
      {wrong !== "" && <title>{wrong}</title>}
      {children}
      <rect className="hit" x={box.x} y={box.y} width={box.width} height={box.height} rx={3} />
      {point && <circle className={`dot ${point}`} cx={dot.x} cy={dot.y} r={3.5} />}
    </g>
  );
}

/** What is wrong at a place; empty where nothing is. */
export function wrongAt(wrong: string, key: string): string {
  if (wrong === "") return "";
  const line = wrong.split("\n").find((each) => each.startsWith(`${key} `));
  return line?.slice(key.length + 1) ?? "";
}

/** Whether an element is chosen, or the branches that it is in. */
export const isChosen = (chosen: string, key: string) =>
  chosen.split(" ").some((each) => key === each || key.startsWith(`${each}.`));

/** Which side of a verification has power on a wire: `A`, `B`; `X` where values differ. Undefined where both are the same. */
export const apartAt = (apart: string, wire: string | number) => {
  const key = String(wire).toUpperCase();
  return apart === ""
    ? undefined
    : apart
        .split(" ")
        .find((each) => each.slice(0, -1) === key)
        ?.slice(-1);
};

const pointsIn = (points: string) =>
  new Map(
    points.split(",").map((each) => {
      const [place = "", shape = ""] = each.split(" ");
      return [place, shape] as const;
    }),
  );
