import type { IconName } from "./drawings";

/** How the life of an error is shown: dashed ring, filled bolt, hollow bolt. */
export const STATUS_ICONS: Record<"never" | "generated" | "cleared", IconName> = {
  never: "never",
  generated: "generated",
  cleared: "cleared",
};
