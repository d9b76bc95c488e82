import { useState } from "react";
import { decodeText } from "../../../logic/format/decode";
import { messageOf } from "../../../logic/format/messageOf";
import { placeFor } from "../../../logic/project/explorer";
import { openFile } from "../../../store/page/navigate";
import { createFile, useDocuments } from "../../../store/project/documents";
import { t } from "../../../text";

export interface Adding {
  add: (chosen: readonly File[]) => Promise<void>;
  /** The refused files, with the reason. */
  refused: readonly string[];
  forget: () => void;
}

/** Adds chosen or dropped files to the project, and opens the first. */
export function useAddFiles(): Adding {
  const [refused, setRefused] = useState<readonly string[]>([]);

  async function add(chosen: readonly File[]): Promise<void> {
    const refusals: string[] = [];
    const added: string[] = [];
    for (const file of chosen) {
      try {
        added.push(await addFile(file));
      } catch (error) {
        refusals.push(`${file.name}: ${messageOf(error)}`);
      }
    }
    setRefused(refusals);
    const [first] = added;
    if (first !== undefined) openFile(first, 1);
  }

  return { add, refused, forget: () => setRefused([]) };
}

/** Tables go to the plant without a question. */
async function addFile(file: File): Promise<string> {
  const path = placeFor(file.name);
  const known = useDocuments.getState().files;
  if (known.some((other) => other.path.toLowerCase() === path.toLowerCase())) throw new Error(t("file.add.exists"));
  await createFile(path, decodeText(new Uint8Array(await file.arrayBuffer())));
  return path;
}
