/** When the texts that the server has not acknowledged are kept in this browser. */

import { afterFrame } from "../page/afterFrame";
import { useDocuments } from "./documentState";
import { sharedText, unsent } from "./drafts";
import { forgetDraft, keepUnsent, recallDraft } from "./keptDrafts";

const pending = new Set<string>();

/** What the server did not acknowledge is kept in this browser, also when the tab is closed already. A key is drawn, and sent, before that. */
export function keepPending(path: string): void {
  pending.add(path);
  afterFrame(keepAllPending);
}

function keepAllPending(): void {
  const paths = [...pending];
  pending.clear();
  for (const path of paths) keepNow(path);
}

function keepNow(path: string): void {
  const { project, open } = useDocuments.getState();
  const shared = sharedText(path);
  if (project === null || !shared) return;
  const lacking = unsent(path);
  const version = open[path]?.version ?? recallDraft(project, path)?.version ?? 0;
  if (lacking) keepUnsent(project, path, { ...lacking, text: shared.value, version });
  else forgetDraft(project, path);
}
