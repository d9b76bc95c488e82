/** What the code saw in one part of a drawing, followed while it is in sight. */

import { type PartFlow, partFlow } from "../../../../logic/graphic/flow";
import { holds } from "../../../../logic/graphic/places";
import type { DrawnPart } from "../../../../logic/graphic/sheet";
import { isBuilt } from "../../../../logic/plc/sourceLines";
import { lookAtFlow, useFlow } from "../../../../store/debug/flow";
import { useBench } from "../../../../store/plc/bench";
import { usePlc } from "../../../../store/plc/plc";
import { useDocuments } from "../../../../store/project/documents";
import { shownText, showsRan } from "../../../../store/project/shownProgram";
import type { Flows, Pou } from "../../../../wire/types";
import { builtLine, shownLine } from "../halt";

/** The flow through a part; null where the text of the part is not the one that ran, or nothing is known. */
export function flowOfPart(part: DrawnPart, path: string, flows: Flows | null): PartFlow | null {
  if (!flows || flows.file !== path) return null;
  const current = showsRan(path) || flows.program_version === useBench.getState().project?.version;
  const { built, text } = shownText(path);
  if (!showsRan(path) && isWrong(part, path)) return null;
  if (!current || !isBuilt(text, built, part.found.line, part.found.text)) return null;
  const { first, last } = linesOf(part, path);
  if (first < flows.first || last > flows.last) return null; // It has just come into sight.
  return partFlow(part, flows.flows, built === text ? (line) => line : (line) => shownLine(path, line));
}

/** A text with an error was never built, also where it was saved. */
function isWrong(part: DrawnPart, path: string): boolean {
  const { problems } = useDocuments.getState();
  return problems.some((each) => each.severity === "error" && each.file === path && holds(part, each.line));
}

/** Where the part is in the text that was built. */
function linesOf({ found }: DrawnPart, path: string): { first: number; last: number } {
  const first = builtLine(path, found.line);
  return { first, last: first + found.text.split("\n").length };
}

/** Whether a part that a PLC has a program for is not in that program as it is drawn. */
export function isUnbuilt(part: DrawnPart, path: string): boolean {
  if (!part.readable || part.found.head.off || usePlc.getState().state === null || showsRan(path)) return false;
  const { built, text } = shownText(path);
  return isWrong(part, path) || !isBuilt(text, built, part.found.line, part.found.text);
}

/** Calls `paint` now and with each answer, until the returned function is called. */
export function followFlow(
  part: DrawnPart,
  path: string,
  pou: Pou,
  paint: (flow: PartFlow | null) => void,
): () => void {
  const stopLooking = lookAtFlow(pou.name, linesOf(part, path));
  let known: Flows | null = null;
  const look = () => {
    const flows = useFlow.getState().of.get(pou.name) ?? null;
    if (flows === known) return;
    known = flows;
    paint(flowOfPart(part, path, flows));
  };
  const stop = useFlow.subscribe(look);
  look();
  return () => {
    stop();
    stopLooking();
  };
}

/** Whether the values that are shown are those that the scan which was noted has left. While the PLC runs they are of a later one. */
export function isStill(): boolean {
  const { state } = usePlc.getState();
  return state !== null && state.state !== "running";
}
