import type { IconName } from "./drawings";

/** How the life of an error is shown: dashed ring, filled bolt, hollow bolt. */
export const STATUS_ICONS: Record<"never" | "generated" | "cleared", IconName> = {
  never: "never",
  generated: "generated",
  cleared: "cleared",
};

/** What the program did about an error: shield, eye, struck eye, stopped. The tone of each is its own name (base.css). */
export const VERDICT_ICONS: Record<"reacted" | "no_effect" | "never_read" | "stopped", IconName> = {
  reacted: "handled",
  no_effect: "noeffect",
  never_read: "unhandled",
  stopped: "stopped",
};
