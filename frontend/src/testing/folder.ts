/** A folder as a browser gives it to whoever it is dropped on: names lead to texts, or to more of that; an error cannot be read. */
interface Tree {
  [name: string]: string | Error | Tree;
}

export function folderEntry(name: string, tree: Tree, around = ""): FileSystemDirectoryEntry {
  const fullPath = `${around}/${name}`;
  const parts = Object.entries(tree).map(([child, inside]) =>
    typeof inside === "string" || inside instanceof Error
      ? fileEntry(child, inside, fullPath)
      : folderEntry(child, inside, fullPath),
  );
  const createReader = () => {
    const rest = [...parts];
    return { readEntries: (done: (part: FileSystemEntry[]) => void) => done(rest.splice(0, 2)) };
  };
  return { name, fullPath, isDirectory: true, isFile: false, createReader } as unknown as FileSystemDirectoryEntry;
}

function fileEntry(name: string, text: string | Error, around: string): FileSystemEntry {
  const file = (done: (file: File) => void, fail: (error: Error) => void) =>
    text instanceof Error ? fail(text) : done(new File([text], name));
  return { name, fullPath: `${around}/${name}`, isDirectory: false, isFile: true, file } as unknown as FileSystemEntry;
}
