/** Lines between the PLC and who communicates with it. */
import { t } from "../../text";
import type { CommunicationFault, LineKind } from "../../wire/types";

/** Whether there are numbers of nodes or units, of which one can be wrong. */
export const hasNodes = (kind: LineKind) => kind !== "opcua" && kind !== "plant";

/** For how long a fault is there; others than those that are offered come from scripts. */
export function lastsWord({ scans, period }: Pick<CommunicationFault, "scans" | "period">): string {
  if (scans == null) return t("communication.lasts.stay");
  return period == null ? t("communication.lasts.for", { scans }) : t("communication.lasts.again", { scans, period });
}
