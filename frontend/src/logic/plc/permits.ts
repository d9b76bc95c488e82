/** What may be done to a PLC now, and if not, why: one table for every control of the page. The PLC itself has the last word. */

import type { TextKey } from "../../text";
import type { InstanceState } from "../../wire/types";
import { waitsForSpace } from "./plcstate";

export type Deed = "write" | "force" | "errors" | "mode" | "run" | "restart" | "newrun" | "change" | "build" | "travel";

/** Devices in RUN take nothing from a tool; errors come from the machine, so the error simulator goes on. */
const NOT_IN_RUN: readonly Deed[] = ["write", "force", "change"];

/** The text that says why something cannot be done now; null when it can. */
export function forbidden(state: InstanceState | null, connected: boolean, deed: Deed): TextKey | null {
  // A build needs no PLC; one that shows its past waits, and could not take the program.
  if (deed === "build") return state?.past ? "permit.past.build" : null;
  if (!connected || state === null) return "permit.offline";
  if (!state.startable) return "permit.model";
  const unreachable = unreachableBy(state);
  // A new run has a new process: it needs nothing of the old one.
  if (unreachable !== null) return deed === "newrun" ? null : unreachable;
  if (state.past !== null) return deed === "travel" ? null : "permit.past";
  if (state.state === "off") return "permit.off";
  if (state.mode === "RUN" && NOT_IN_RUN.includes(deed)) return deed === "change" ? "permit.run.change" : "permit.run";
  return null;
}

/** Why nothing reaches the program, in the past or live; null when it does. */
function unreachableBy(state: InstanceState): TextKey | null {
  if (state.state === "silent") return "permit.silent";
  if (state.state === "failed") return "permit.failed";
  return waitsForSpace(state) ? "permit.no_space" : null;
}
