/** Which steps are possible in which state of the PLC. */
import type { InstanceState } from "../../wire/types";

type Command = "continue" | "pause" | "next" | "stepIn" | "stepOut" | "stepBack" | "reverseContinue";

const STILL = ["halted", "paused", "past"];
/** The program cannot continue, but people can step back and see how it got there. */
const ENDED = ["trapped", "fatal", "stopped"];

/** The page shows the PLC at a statement or in a seam. */
const isStill = (state: InstanceState | null) => state !== null && STILL.includes(state.state);

export function permits(state: InstanceState | null, command: Command): boolean {
  if (state === null) return false;
  if (command === "pause") return state.state === "running";
  if (command === "stepOut") return isStill(state) && (state.halt?.count ?? 0) > 0;
  if (command === "continue") return isStill(state);
  if (command === "stepBack" || command === "reverseContinue") return isStill(state) || ENDED.includes(state.state);
  return isStill(state) || state.state === "running";
}
