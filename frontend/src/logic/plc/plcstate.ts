/** How a state of the PLC is shown: tone, icon and words. One table, so that bar, rail and status bar agree. */

import { t } from "../../text";
import type { InstanceState, RunState } from "../../wire/types";
import { grouped, interval } from "../format/numbers";
import { haltDetail, haltShort } from "./halted";

type Tone = "running" | "halted" | "stopped" | "fatal" | "past" | "stale";

/** Names of drawings in `ui/drawings.tsx`. */
type StateIcon = "running" | "halted" | "stopped" | "fatal" | "lost" | "wait" | "refresh" | "error" | "past" | "off";

export interface ShownState {
  tone: Tone;
  icon: StateIcon;
  word: string;
  detail: string;
  /** The short form of the detail, where it differs. */
  short?: string;
}

const LOOKS: Record<RunState, { tone: Tone; icon: StateIcon }> = {
  starting: { tone: "stopped", icon: "wait" },
  running: { tone: "running", icon: "running" },
  paused: { tone: "halted", icon: "halted" },
  halted: { tone: "halted", icon: "halted" },
  stopped: { tone: "stopped", icon: "stopped" },
  fatal: { tone: "fatal", icon: "fatal" },
  trapped: { tone: "fatal", icon: "fatal" },
  restarting: { tone: "halted", icon: "refresh" },
  silent: { tone: "stale", icon: "lost" },
  failed: { tone: "fatal", icon: "error" },
  past: { tone: "past", icon: "past" },
  off: { tone: "stopped", icon: "off" },
  no_space: { tone: "fatal", icon: "wait" },
};

/** Whether the PLC has no process because its run cannot be recorded. A PLC with a process answers while it waits for disk space. */
export const waitsForSpace = (state: InstanceState) => state.state === "no_space" && state.pid === null;

export function showState(state: InstanceState | null, connected: boolean): ShownState {
  if (!connected || !state) {
    return { tone: "stale", icon: "lost", word: t("state.unknown"), detail: t("state.noconnection") };
  }
  const fallback = state.state === "running" ? t("state.cyclic", { interval: interval(state.interval_ns) }) : "";
  return {
    ...LOOKS[state.state],
    word: t(`state.${state.state}`),
    detail: detailOf(state) || state.message || fallback,
    ...(state.state === "halted" && state.halt ? { short: haltShort(state.halt) } : {}),
  };
}

function detailOf(state: InstanceState): string {
  switch (state.state) {
    case "running":
      return state.target || t("state.cyclic", { interval: interval(state.interval_ns) });
    case "starting":
      return t("state.loading");
    case "fatal":
      return t("state.outputsoff");
    case "trapped":
      return state.trap ? `${state.trap.file}:${state.trap.line}` : "";
    case "halted":
      return state.halt ? haltDetail(state.halt) : "";
    case "stopped":
      return t("state.noprogram");
    case "past":
      if (state.halt && state.halt.file !== "") return t("debug.past", { line: state.halt.line });
      return t("state.readonly", { scan: grouped(state.scan) });
    case "silent":
      return t("state.silent.detail");
    case "off":
      return t("state.switchedoff");
    case "no_space":
      return t("state.no_space.detail");
    default:
      return "";
  }
}
