import type { IconName } from "../../../ui/Icon";
import type { SweepSummary } from "../../../wire/types";

/** How the status of a sweep is shown. */
export const STATUS: Record<SweepSummary["status"], { icon: IconName; tone: string }> = {
  running: { icon: "record", tone: "info" },
  done: { icon: "check", tone: "running" },
  cancelled: { icon: "stopped", tone: "stopped" },
  interrupted: { icon: "warning", tone: "warning" },
  failed: { icon: "error", tone: "fatal" },
};
