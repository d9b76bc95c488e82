/** Lines between the PLC and who communicates with it. */
import type { LineKind } from "../../wire/types";

/** Whether there are numbers of nodes or units, of which one can be wrong. */
export const hasNodes = (kind: LineKind) => kind !== "opcua" && kind !== "plant";
