/** Unsaved texts that this browser keeps, because nobody else has them: not yet acknowledged by the server, or without a draft there. */
import { forget, keep, recall } from "../page/localStorage";

export interface KeptDraft {
  text: string;
  /** The saved version from which it was made. */
  version: number;
  /** What the server did not acknowledge of its draft. */
  unsent?: { draft: string; update: string };
}

const key = (project: number, path: string) => `draft.${project}.${path}`;

export const recallDraft = (project: number, path: string) => recall<KeptDraft | null>(key(project, path), null);
export const keepDraft = (project: number, path: string, draft: KeptDraft) => keep(key(project, path), draft);
export const forgetDraft = (project: number, path: string) => forget(key(project, path));
