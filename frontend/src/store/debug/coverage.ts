/** The statements executed since coverage was switched on; shared by everybody at the PLC. */

import { create } from "zustand";
import { t } from "../../text";
import { send } from "../../wire/send";
import type { Coverage } from "../../wire/types";
import { onInstanceChange } from "../plc/reset";
import { useDebug } from "./debug";

export const useCoverage = create<{ coverage: Coverage | null }>(() => ({ coverage: null }));

export function onCoverage(coverage: Coverage | null): void {
  useCoverage.setState({ coverage });
}

onInstanceChange(() => onCoverage(null));

/** `reset` forgets what was recorded so far. */
export async function setCoverage(on: boolean, reset = false): Promise<void> {
  const answer = await send({ type: "set_coverage", on, reset });
  useDebug.setState({ refused: answer.ok ? null : answer.message || t("notsent") });
}
