/**
 * Unsaved texts that this browser keeps, because nobody else has them: not yet acknowledged by the server, or without a draft there. Several
 * pages of one browser keep each their own unacknowledged changes, and none forgets what a different page wrote.
 */
import { forgetSame, keepText, keysOf, recall } from "../page/localStorage";

/** What the server did not acknowledge of a draft. */
interface Unsent {
  draft: string;
  update: string;
  /** The text of the draft with it. */
  text: string;
  /** The saved version that was known. */
  version: number;
}

/** A text that was typed without a draft. */
interface Plain {
  text: string;
  /** The saved version from which it was made. */
  version: number;
  /** The text of the draft from which it was made, where it is one that the server may not have. */
  base?: string | undefined;
}

export interface KeptDraft extends Plain {
  unsent: readonly Unsent[];
}

/** Of this page alone. */
const page = Math.random().toString(36).slice(2);
/** What this page wrote or brought in, by key: it may forget that, but nothing newer. */
const own = new Map<string, string>();

const plainKey = (project: number, path: string) => `draft.${project}.${path}`;
/** No path has two slashes one after the other. */
const unsentKeys = (project: number, path: string) => `unsent.${project}.${path}//`;
const keysFor = (project: number, path: string) => [plainKey(project, path), ...keysOf(unsentKeys(project, path))];

export function recallDraft(project: number, path: string): KeptDraft | null {
  const plain = recall<Plain | null>(plainKey(project, path), null);
  const unsent = keysOf(unsentKeys(project, path)).flatMap((key) => recall<Unsent | null>(key, null) ?? []);
  const last = unsent.at(-1);
  if (plain) return { ...plain, base: plain.base, unsent };
  return last ? { text: last.text, version: last.version, base: last.text, unsent } : null;
}

/** What is kept becomes part of this page's text: when all that is acknowledged, it is forgotten. */
export function bringDraft(project: number, path: string): KeptDraft | null {
  for (const key of keysFor(project, path)) own.set(key, JSON.stringify(recall<unknown>(key, null)));
  return recallDraft(project, path);
}

export function keepPlain(project: number, path: string, { text, version, base }: Plain): void {
  write(plainKey(project, path), { text, version, base });
}

export function keepUnsent(project: number, path: string, unsent: Unsent): void {
  write(unsentKeys(project, path) + page, unsent);
}

function write(key: string, value: object): void {
  const text = JSON.stringify(value);
  if (keepText(key, text)) own.set(key, text);
}

export function forgetDraft(project: number, path: string): void {
  for (const key of keysFor(project, path)) {
    const text = own.get(key);
    own.delete(key);
    if (text !== undefined) forgetSame(key, text);
  }
}
