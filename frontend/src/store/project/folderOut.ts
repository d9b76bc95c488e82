/** A project as files in a folder that somebody chose: in browsers that may write to one. */

import { type FolderPlan, planFor, writeInto } from "../../logic/project/folderOut";
import { rest } from "../../wire/rest";
import type { Project } from "../../wire/types";

/** Of the File System Access specification; Firefox and Safari do not have it. */
interface FolderPicker {
  showDirectoryPicker(options: { id: string; mode: "readwrite" }): Promise<FileSystemDirectoryHandle>;
}

const hasPicker = (page: object): page is FolderPicker => "showDirectoryPicker" in page;

export const canChooseFolder = (): boolean => hasPicker(window);

/** The folder that somebody chose; null where nobody did. */
export async function chooseFolder(): Promise<FileSystemDirectoryHandle | null> {
  if (!hasPicker(window)) return null;
  try {
    return await window.showDirectoryPicker({ id: "project", mode: "readwrite" });
  } catch (error) {
    if (error instanceof DOMException && error.name === "AbortError") return null;
    throw error;
  }
}

/** What the folder would get: the files of the project as they are saved on the server. */
export async function planFolder({ id }: Project, folder: FileSystemDirectoryHandle): Promise<FolderPlan> {
  const [packed, { unzipSync }] = await Promise.all([rest.packProject(id), import("fflate")]);
  const files = Object.entries(unzipSync(new Uint8Array(await packed.arrayBuffer())));
  return planFor(
    folder,
    files.filter(([path]) => !path.endsWith("/")).map(([path, bytes]) => ({ path, bytes: new Uint8Array(bytes) })),
  );
}

/** Writes what is new or has other contents there. */
export const writeFolder = (folder: FileSystemDirectoryHandle, { fresh, changed }: FolderPlan): Promise<void> =>
  writeInto(folder, [...fresh, ...changed]);
