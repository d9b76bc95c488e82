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
  const [selected, halted] = [key === marked.cursor, key === marked.next];
  const point = pointsIn(marked.points).get(key);
  return (
    <g
      id={`${marked.id}-${key}`}
      // Classes are what is live: to select an element must not take them away.
      className={`el ${kind}`}
      data-next={halted || undefined}
      role="option"
      aria-selected={selected}
      aria-label={[name, halted && t("graphic.next"), point && t("graphic.point")].filter(Boolean).join(", ")}
      data-element={key}
    >
      {children}
      <rect className="hit" x={box.x} y={box.y} width={box.width} height={box.height} rx={3} />
      {point && <circle className={`dot ${point}`} cx={dot.x} cy={dot.y} r={3.5} />}
    </g>
  );
}

const pointsIn = (points: string) =>
  new Map(
    points.split(",").map((each) => {
      const [place = "", shape = ""] = each.split(" ");
      return [place, shape] as const;
    }),
  );
