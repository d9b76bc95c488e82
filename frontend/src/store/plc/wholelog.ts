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

let asked = 0;

/** Shows the lines from the number `first` on, or the last ones, of one kind or of all. */
export async function turnTo(first: number | null, kind: LogLine["kind"] | null): Promise<void> {
  const instance = useBench.getState().instance?.id;
  if (instance === undefined) return;
  asked += 1;
  const mine = asked;
  useWholeLog.setState({ busy: true, trouble: "" });
  let now: Partial<WholeLog>;
  try {
    now = { page: await rest.logPage(instance, first, kind) };
  } catch (error) {
    now = { trouble: messageOf(error) };
  }
  // The answer to an older question, or one that comes when somebody is live again, is not wanted any more.
  if (mine === asked) useWholeLog.setState({ ...now, busy: false });
}

export function goLive(): void {
  asked += 1;
  useWholeLog.setState(LIVE);
}

// The pages of a different PLC are not its.
useBench.subscribe((now, before) => {
  if (now.instance?.id !== before.instance?.id) goLive();
});
