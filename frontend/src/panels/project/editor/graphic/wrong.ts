/** What the compiler says about a part of a drawing, at the elements and pins that it means. */

import { holds, stopIn } from "../../../../logic/graphic/places";
import type { DrawnPart } from "../../../../logic/graphic/sheet";
import type { Problem } from "../../../../wire/types";

export interface Wrong {
  /** Joined by points; empty where no element is meant. */
  place: string;
  problem: Problem;
}

const NONE: readonly Wrong[] = [];

/** Errors of a part, in the order of the text. */
export function wrongIn(part: DrawnPart, path: string, problems: readonly Problem[]): readonly Wrong[] {
  const here = problems.filter((each) => each.severity === "error" && each.file === path && holds(part, each.line));
  if (here.length === 0) return NONE;
  return here.map((problem) => ({ place: (stopIn(part, problem) ?? []).join("."), problem }));
}

/** As a drawing takes it: equal texts mean that nothing is different. */
export const wrongText = (wrong: readonly Wrong[]): string =>
  wrong
    .filter(({ place }) => place !== "")
    .map(({ place, problem }) => `${place} ${problem.message.replace(/\s+/g, " ")}`)
    .join("\n");
