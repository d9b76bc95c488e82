/** A project as files in a folder of this computer: what would change there, and the writing. */

interface FolderFile {
  /** With its folders: `POUs/Belt.st`. */
  path: string;
  bytes: Uint8Array<ArrayBuffer>;
}

/** Each file is in one of the lists. Other files of the folder are never touched. */
export interface FolderPlan {
  fresh: readonly FolderFile[];
  /** The folder has them with other contents. */
  changed: readonly FolderFile[];
  same: readonly FolderFile[];
}

/** Compares the files with those that the folder has. Throws what the browser says, with the path before it. */
export async function planFor(folder: FileSystemDirectoryHandle, files: readonly FolderFile[]): Promise<FolderPlan> {
  const plan = { fresh: [] as FolderFile[], changed: [] as FolderFile[], same: [] as FolderFile[] };
  for (const file of files) {
    const there = await naming(file, () => bytesIn(folder, file.path));
    if (there === null) plan.fresh.push(file);
    else (isSame(there, file.bytes) ? plan.same : plan.changed).push(file);
  }
  return plan;
}

/** Writes these files, and makes the folders that are missing. Each file is replaced whole. */
export async function writeInto(folder: FileSystemDirectoryHandle, files: readonly FolderFile[]): Promise<void> {
  for (const file of files) {
    await naming(file, async () => {
      const [parents, name] = split(file.path);
      let at = folder;
      for (const parent of parents) at = await at.getDirectoryHandle(parent, { create: true });
      const stream = await (await at.getFileHandle(name, { create: true })).createWritable();
      await stream.write(file.bytes);
      await stream.close();
    });
  }
}

/** The file's contents; null where the folder has no such file. */
async function bytesIn(folder: FileSystemDirectoryHandle, path: string): Promise<Uint8Array | null> {
  const [parents, name] = split(path);
  try {
    let at = folder;
    for (const parent of parents) at = await at.getDirectoryHandle(parent);
    const file = await (await at.getFileHandle(name)).getFile();
    return new Uint8Array(await file.arrayBuffer());
  } catch (error) {
    if (error instanceof DOMException && error.name === "NotFoundError") return null;
    throw error;
  }
}

function split(path: string): [readonly string[], string] {
  const parts = path.split("/");
  return [parts.slice(0, -1), parts.at(-1) ?? ""];
}

const isSame = (a: Uint8Array, b: Uint8Array) => a.length === b.length && a.every((byte, at) => byte === b[at]);

async function naming<T>({ path }: FolderFile, work: () => Promise<T>): Promise<T> {
  try {
    return await work();
  } catch (error) {
    throw new Error(`${path}: ${error instanceof Error ? error.message : String(error)}`);
  }
}
