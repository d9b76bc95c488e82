import { useRef, useState } from "react";
import { decodeText } from "../../../logic/format/decode";
import { messageOf } from "../../../logic/format/messageOf";
import { filesIn } from "../../../logic/project/droppedFolder";
import { isWholeProject, placeFor } from "../../../logic/project/explorer";
import { openFile } from "../../../store/page/navigate";
import { createFile, useDocuments } from "../../../store/project/documents";
import { t } from "../../../text";

/** What became of chosen or dropped files. */
export interface Report {
  /** Paths in the project. */
  added: readonly string[];
  left: readonly { path: string; why: string }[];
  /** Somebody ended it before all were added. */
  ended: boolean;
}

export interface Adding {
  /** Files alone are only told about if one of them was refused; of folders all is told. */
  add: (files: readonly File[], folders?: readonly FileSystemDirectoryEntry[]) => Promise<void>;
  progress: { done: number; of: number } | null;
  /** Ends it after the file that is being added. */
  end: () => void;
  report: Report | null;
  forget: () => void;
}

/** Adds chosen or dropped files to the project, and opens the first. */
export function useAddFiles(): Adding {
  const [report, setReport] = useState<Report | null>(null);
  const [progress, setProgress] = useState<Adding["progress"]>(null);
  const ended = useRef(false);

  async function add(chosen: readonly File[], folders: readonly FileSystemDirectoryEntry[] = []): Promise<void> {
    ended.current = false;
    const added: string[] = [];
    const found = await filesIn(folders);
    const files = [...chosen.map((file) => ({ path: file.name, file })), ...found.files];
    const left = found.left.map(({ path, why }) => ({ path, why: t(`file.left.${why}`) }));
    for (const [done, { path, file }] of files.entries()) {
      if (ended.current) break;
      if (files.length > 1) setProgress({ done, of: files.length });
      try {
        added.push(await addFile(path, file));
      } catch (error) {
        left.push({ path, why: messageOf(error) });
      }
    }
    setProgress(null);
    if (folders.length > 0 || left.length > 0) setReport({ added, left, ended: ended.current });
    const [first] = added;
    if (first !== undefined) openFile(first, 1);
  }

  const end = () => {
    ended.current = true;
  };
  return { add, progress, end, report, forget: () => setReport(null) };
}

/** Tables go to the plant without a question. */
async function addFile(name: string, file: File): Promise<string> {
  if (isWholeProject(name)) throw new Error(t("file.left.project"));
  const path = placeFor(name);
  const known = useDocuments.getState().files;
  if (known.some((other) => other.path.toLowerCase() === path.toLowerCase())) throw new Error(t("file.add.exists"));
  await createFile(path, decodeText(new Uint8Array(await file.arrayBuffer())));
  return path;
}
