/** Asks the compiler about the texts as they are edited. */

import { messageOf } from "../../logic/format/messageOf";
import { rest } from "../../wire/rest";
import { isDirty, useDocuments } from "./documentState";

const get = useDocuments.getState;
const set = useDocuments.setState;

/** A check takes the server some 15 ms: a problem should be visible while the finger leaves the key. */
const CHECK_DELAY = 50;
let checkTimer: ReturnType<typeof setTimeout> | undefined;
let checkTurn = 0;

export function scheduleCheck(): void {
  clearTimeout(checkTimer);
  checkTimer = setTimeout(() => void check(), CHECK_DELAY);
}

/** Asks the compiler about the edited texts; an outdated answer is dropped. */
export async function check(): Promise<void> {
  const { project, open, wantsNumbers } = get();
  if (project === null) return;
  checkTurn += 1;
  const turn = checkTurn;
  const dirty = Object.values(open).filter(isDirty);
  try {
    const result = await rest.check(
      project,
      Object.fromEntries(dirty.map((document) => [document.path, document.text])),
      wantsNumbers,
    );
    if (turn !== checkTurn || get().project !== project) return;
    const broken = result.problems.some((problem) => problem.severity === "error");
    set({
      problems: result.problems,
      pous: result.pous,
      ...(broken ? {} : { checks: result.checks, tasks: result.tasks }),
    });
    if (wantsNumbers && get().wantsNumbers) set({ numbers: result.numbers ?? null });
  } catch (error) {
    if (turn === checkTurn) set({ trouble: messageOf(error) });
  }
}
