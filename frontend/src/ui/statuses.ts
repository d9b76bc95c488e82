import type { IconName } from "./drawings";

/** The icon of an error's status: dashed ring, filled bolt, hollow bolt. */
export const STATUS_ICONS: Record<"never" | "generated" | "cleared", IconName> = {
  never: "never",
  generated: "generated",
  cleared: "cleared",
};

/** The icon of a verdict: shield, fork, screen, drawer, eye, arrow past a bar, struck eye, stopped; and two of before there were grades. Each verdict has a tone of the same name (base.css). */
export const VERDICT_ICONS: Record<
  | "acted"
  | "decided"
  | "displayed"
  | "stored"
  | "no_effect"
  | "not_reached"
  | "never_read"
  | "stopped"
  | "reacted"
  | "stored_only",
  IconName
> = {
  acted: "handled",
  decided: "decided",
  displayed: "displayed",
  stored: "stored",
  reacted: "handled",
  stored_only: "stored",
  no_effect: "noeffect",
  not_reached: "notreached",
  never_read: "unhandled",
  stopped: "stopped",
};
