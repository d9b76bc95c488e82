/** The whole event log of the PLC, page by page: the live panel holds only what came lately. */
import { create } from "zustand";
import { messageOf } from "../../logic/format/messageOf";
import { rest } from "../../wire/rest";
import type { LogLine, LogPage } from "../../wire/types";
import { useBench } from "./bench";

/** Lines of a page, as many as the server gives at once. */
export const LOG_PAGE = 1000;

interface WholeLog {
  /** Null: the panel is live. */
  page: LogPage | null;
  busy: boolean;
  trouble: string;
}

const LIVE: WholeLog = { page: null, busy: false, trouble: "" };
export const useWholeLog = create<WholeLog>(() => LIVE);

/** Shows the lines from the number `first` on, or the last ones, of one kind or of all. */
export async function turnTo(first: number | null, kind: LogLine["kind"] | null): Promise<void> {
  const instance = useBench.getState().instance?.id;
  if (instance === undefined) return;
  useWholeLog.setState({ busy: true, trouble: "" });
  try {
    const page = await rest.logPage(instance, first, kind);
    if (useBench.getState().instance?.id === instance) useWholeLog.setState({ page, busy: false });
  } catch (error) {
    useWholeLog.setState({ busy: false, trouble: messageOf(error) });
  }
}

export function goLive(): void {
  useWholeLog.setState(LIVE);
}

// The pages of a different PLC are not its.
useBench.subscribe((now, before) => {
  if (now.instance?.id !== before.instance?.id) goLive();
});
