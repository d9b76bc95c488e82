/** A folder that a page may write to, as the File System Access specification describes it: paths lead to texts. Without `write` the browser refuses to write. */
export function folderHandle(texts: Map<string, string>, options = { write: true }): FileSystemDirectoryHandle {
  const missing = (name: string) => new DOMException(`${name} is not there`, "NotFoundError");
  const folders = new Set(
    [...texts.keys()].flatMap((path) => path.split("/").map((_, n, all) => all.slice(0, n).join("/"))),
  );

  const fileHandle = (path: string) => ({
    getFile: async () => new File([texts.get(path) ?? ""], path),
    createWritable: async () => {
      if (!options.write) throw new DOMException("The folder is read-only", "NotAllowedError");
      const parts: BlobPart[] = [];
      return {
        write: async (part: BlobPart) => void parts.push(part),
        close: async () => void texts.set(path, await new Blob(parts).text()),
      };
    },
  });

  const at = (around: string, name: string): unknown => ({
    name,
    getDirectoryHandle: async (child: string, { create = false } = {}) => {
      const path = `${around}${child}`;
      if (!create && !folders.has(path)) throw missing(path);
      folders.add(path);
      return at(`${path}/`, child);
    },
    getFileHandle: async (child: string, { create = false } = {}) => {
      const path = `${around}${child}`;
      if (folders.has(path)) throw new DOMException(`${path} is a folder`, "TypeMismatchError");
      if (!create && !texts.has(path)) throw missing(path);
      return fileHandle(path);
    },
  });
  return at("", "Line") as FileSystemDirectoryHandle;
}
