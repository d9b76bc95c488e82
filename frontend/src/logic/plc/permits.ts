/** What may be done to a PLC now, and if not, why: one table for every control of the page. The PLC itself decides in the end. */

import type { TextKey } from "../../text";
import type { InstanceState } from "../../wire/types";
import { waitsForSpace } from "./plcstate";

export type Deed = "write" | "force" | "errors" | "mode" | "run" | "restart" | "newrun" | "change" | "build" | "travel";

/** In RUN a device takes no changes from a tool; errors come from the machine, so the error simulator stays usable. */
const NOT_IN_RUN: readonly Deed[] = ["write", "force", "change"];

/** The text that says why something cannot be done now; null when it can be done. */
export function forbidden(state: InstanceState | null, connected: boolean, deed: Deed): TextKey | null {
  // A build is possible without a PLC. A PLC that shows its past is paused and could not take the program.
  if (deed === "build") return state?.past ? "permit.past.build" : null;
  if (!connected || state === null) return "permit.offline";
  if (!state.startable) return "permit.model";
  const unreachable = unreachableBy(state);
  // A new run has a new process: the old process may be in any state.
  if (unreachable !== null) return deed === "newrun" ? null : unreachable;
  if (state.past !== null) return deed === "travel" ? null : "permit.past";
  if (state.state === "off") return "permit.off";
  if (state.mode === "RUN" && NOT_IN_RUN.includes(deed)) return deed === "change" ? "permit.run.change" : "permit.run";
  return null;
}

/** Why the program cannot be reached, in the past or live; null when it can. */
function unreachableBy(state: InstanceState): TextKey | null {
  if (state.state === "silent") return "permit.silent";
  if (state.state === "failed") return "permit.failed";
  return waitsForSpace(state) ? "permit.no_space" : null;
}
