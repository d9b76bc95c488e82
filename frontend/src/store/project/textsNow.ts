/** The texts of the files as people edit them now: as they are here, else as the server keeps what nobody saved, else as saved. */
import { rest } from "../../wire/rest";
import type { FileInfo } from "../../wire/types";
import { textHere, useDocuments } from "./documents";
import { savedText } from "./sourceText";

/** A saved text does not change: it is asked for once, as each key that is typed may need all of them. */
const saved = new Map<string, { version: number; text: Promise<string | null> }>();

/** By path, in the order of `files`; null where the server did not give the text. Throws if it does not say what is not saved. */
export async function textsNow(
  files: readonly Pick<FileInfo, "path" | "version">[],
): Promise<Map<string, string | null>> {
  const { project } = useDocuments.getState();
  const texts = new Map<string, string | null>();
  if (project === null) return texts;
  // Others may edit files that are not open here.
  const elsewhere = files.some(({ path }) => textHere(path) === null);
  const drafts = elsewhere ? await rest.drafts(project) : [];
  const unsaved = new Map(drafts.map(({ path, text }) => [path, text]));
  for (const { path, version } of files) {
    texts.set(path, textHere(path) ?? unsaved.get(path) ?? (await savedOf(project, path, version)));
  }
  return texts;
}

function savedOf(project: number, path: string, version: number): Promise<string | null> {
  const key = `${project} ${path}`;
  const known = saved.get(key);
  if (known?.version === version) return known.text;
  const text = savedText(path);
  saved.set(key, { version, text });
  void text.then((came) => came === null && saved.get(key)?.text === text && saved.delete(key));
  return text;
}

useDocuments.subscribe(({ project }, before) => {
  if (project !== before.project) saved.clear();
});
