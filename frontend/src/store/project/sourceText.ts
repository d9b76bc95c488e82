/** The last saved text of a file, for panels that show lines of it without opening it. */
import { rest } from "../../wire/rest";
import { useBench } from "../plc/bench";
import { useDocuments } from "./documents";

/** Null: the file does not exist (any more), or nobody answers. */
export async function savedText(path: string): Promise<string | null> {
  const open = useDocuments.getState().open[path];
  if (open) return open.savedText;
  const project = useBench.getState().project?.id;
  const { files, project: listed } = useDocuments.getState();
  if (project === undefined) return null;
  if (listed === project && files.length > 0 && !files.some((file) => file.path === path)) return null;
  try {
    return (await rest.file(project, path)).text;
  } catch {
    return null;
  }
}
