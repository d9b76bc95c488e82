/** The files of folders that were dropped on the page: which of them a project takes, and why it leaves the others out. */
import { FILE_ENDINGS } from "./explorer";

type Why = "hidden" | "kind" | "size" | "unreadable";

interface LeftOut {
  path: string;
  why: Why;
}

interface Found {
  /** With their folders. */
  files: readonly { path: string; file: File }[];
  left: readonly LeftOut[];
}

/** The compiler reads no longer text. */
const LARGEST = 8_000_000;
const ENDINGS = FILE_ENDINGS.split(",");

/** Whether a project has files of this kind. */
const isTaken = (path: string) => ENDINGS.some((ending) => path.toLowerCase().endsWith(ending));

/** All files in and below these folders, in the order of their paths. */
export async function filesIn(folders: readonly FileSystemDirectoryEntry[]): Promise<Found> {
  const files: { path: string; file: File }[] = [];
  const left: LeftOut[] = [];
  const open: FileSystemEntry[] = [...folders];
  for (let entry = open.pop(); entry; entry = open.pop()) {
    const path = entry.fullPath.replace(/^\//, "");
    try {
      if (entry.name.startsWith(".")) left.push({ path, why: "hidden" });
      else if (entry.isDirectory) open.push(...(await entriesOf(entry as FileSystemDirectoryEntry)));
      else if (!isTaken(path)) left.push({ path, why: "kind" });
      else {
        const file = await fileOf(entry as FileSystemFileEntry);
        if (file.size > LARGEST) left.push({ path, why: "size" });
        else files.push({ path, file });
      }
    } catch {
      left.push({ path, why: "unreadable" });
    }
  }
  return { files: files.sort(byPath), left: left.sort(byPath) };
}

const byPath = (a: { path: string }, b: { path: string }) => a.path.localeCompare(b.path);

const fileOf = (entry: FileSystemFileEntry) => new Promise<File>((resolve, reject) => entry.file(resolve, reject));

/** A browser gives them in parts, and ends with an empty one. */
async function entriesOf(folder: FileSystemDirectoryEntry): Promise<FileSystemEntry[]> {
  const reader = folder.createReader();
  const found: FileSystemEntry[] = [];
  for (;;) {
    const part = await new Promise<FileSystemEntry[]>((resolve, reject) => reader.readEntries(resolve, reject));
    if (part.length === 0) return found;
    found.push(...part);
  }
}
