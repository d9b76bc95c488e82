/** What the page knows of the files of the project: `documents.ts` changes it. */

import { create } from "zustand";
import type {
  BuildResult,
  EmbeddedCheck,
  FileInfo,
  FileText,
  OnlineChange,
  Pou,
  Problem,
  RaisedNumber,
  Task,
} from "../../wire/types";

export interface Document {
  path: string;
  text: string;
  savedText: string;
  /** The stored version on which the text is based. */
  version: number;
  /** When the version was saved, and by whom; empty when that is not known. */
  savedAt: string;
  savedBy: string;
  /** The version of somebody who saved meanwhile, to be shown beside one's own. */
  conflict: FileText | null;
  /** The file was deleted, but its edited text stays: who deleted it; empty when that is not known. */
  deletedBy: string | null;
  /** Why the server does not take what was typed last, however often it is sent. */
  refused?: string | null;
  /** The text of a draft from which it was made, as this browser kept it, while the draft itself is not here. */
  base?: string | undefined;
}

export type BuildState =
  | { phase: "idle" }
  | { phase: "running" }
  | {
      phase: "done";
      ok: boolean;
      message: string;
      author: string | null;
      changes: readonly OnlineChange[];
      /** For which the texts were refused. */
      errors: readonly Problem[];
      /** When, as ISO 8601. */
      at: string;
    };

interface Documents {
  project: number | null;
  files: readonly FileInfo[];
  open: Readonly<Record<string, Document>>;
  active: string | null;
  /** Of a drawing with the end of its element. */
  cursor: { line: number; column: number; element?: { line: number; column: number } } | null;
  pous: readonly Pou[];
  problems: readonly Problem[];
  /** The tasks of the edited texts; the last good ones while there are errors. */
  tasks: readonly Task[];
  /** Subrange checks of the edited texts; the last good ones while there are errors. */
  checks: readonly EmbeddedCheck[];
  /** The numbers that the program raises errors with, while somebody wants them; null while it has errors. */
  numbers: readonly RaisedNumber[] | null;
  wantsNumbers: boolean;
  build: BuildState;
  /** A build that waits for confirmation: variables of running PLCs would be reinitialized. */
  asking: BuildResult | null;
  /** What the last online change did to the running PLCs; null when it was rolled back, or there was none. */
  change: readonly OnlineChange[] | null;
  /** A failure that is not about one line: shown at the top of the problem list. */
  trouble: string | null;
}

export const nothing: Omit<Documents, "project" | "wantsNumbers"> = {
  files: [],
  open: {},
  active: null,
  cursor: null,
  pous: [],
  problems: [],
  tasks: [],
  checks: [],
  numbers: null,
  build: { phase: "idle" },
  asking: null,
  change: null,
  trouble: null,
};

export const useDocuments = create<Documents>(() => ({ project: null, wantsNumbers: false, ...nothing }));

/** A text is edited with line feeds, also one that was saved elsewhere with other line ends. */
export const isDirty = (document: Document | undefined) =>
  document !== undefined && document.text !== document.savedText && document.text !== withLineFeeds(document.savedText);

export const withLineFeeds = (text: string) => (text.includes("\r") ? text.replace(/\r\n?/g, "\n") : text);

export function patch(path: string, change: Partial<Document>): void {
  useDocuments.setState(({ open }) => {
    const document = open[path];
    return document ? { open: { ...open, [path]: { ...document, ...change } } } : {};
  });
}
