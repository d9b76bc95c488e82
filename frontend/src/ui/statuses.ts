import type { IconName } from "./drawings";

/** How the life of an error is shown: dashed ring, filled bolt, hollow bolt. */
export const STATUS_ICONS: Record<"never" | "generated" | "cleared", IconName> = {
  never: "never",
  generated: "generated",
  cleared: "cleared",
};

/** What the program did about an error: shield, drawer, eye, arrow past a bar, struck eye, stopped. The tone of each is its own name (base.css). */
export const VERDICT_ICONS: Record<
  "reacted" | "stored_only" | "no_effect" | "not_reached" | "never_read" | "stopped",
  IconName
> = {
  reacted: "handled",
  stored_only: "stored",
  no_effect: "noeffect",
  not_reached: "notreached",
  never_read: "unhandled",
  stopped: "stopped",
};
