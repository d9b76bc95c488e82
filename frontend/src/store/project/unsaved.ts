/** The texts of the project that somebody edited and nobody saved: open here, kept in this browser, or only drafts of the server. */
import { create } from "zustand";
import { spaced } from "../../logic/format/debounce";
import { rest } from "../../wire/rest";
import { holdsUnsaved, isDirty, openDocument, save, useDocuments } from "./documents";
import { othersOf, usePeople } from "./people";

interface Unsaved {
  /** Those that are not open: of the server, and kept in this browser. */
  drafts: readonly string[];
}

export const useUnsaved = create<Unsaved>(() => ({ drafts: [] }));

/** In the order of the files; a text that is open here is known here best. */
export function unsavedPaths(): string[] {
  const { files, open } = useDocuments.getState();
  const { drafts } = useUnsaved.getState();
  return files.map(({ path }) => path).filter((path) => (open[path] ? isDirty(open[path]) : drafts.includes(path)));
}

/** Their paths, one a line: a string, so that a panel is drawn again only when they are different. */
export function useUnsavedPaths(): readonly string[] {
  useUnsaved();
  const text = useDocuments(() => unsavedPaths().join("\n"));
  return text === "" ? [] : text.split("\n");
}

/** Those that are not open here: what others edited, which a build here does not take. */
export function useUnsavedOfOthers(): readonly string[] {
  const open = useDocuments((documents) => documents.open);
  return useUnsavedPaths().filter((path) => !open[path]);
}

/** Saves all of them. The path of the first one that could not be saved; null when all are. */
export async function saveAll(): Promise<string | null> {
  await refreshUnsaved();
  for (const path of unsavedPaths()) {
    await openDocument(path);
    if (!(await save(path))) return path;
  }
  return null;
}

export async function refreshUnsaved(): Promise<void> {
  const { project } = useDocuments.getState();
  if (project === null) return;
  const drafts = await rest.unsaved(project);
  const { files, project: now } = useDocuments.getState();
  const kept = files.map(({ path }) => path).filter(holdsUnsaved);
  if (now === project) useUnsaved.setState({ drafts: [...drafts, ...kept] });
}

const refreshSoon = spaced(() => void refreshUnsaved().catch(() => undefined), 1000);

/** Who opens, saves or leaves a file may have edited it. */
let known = "";
function follow(): void {
  const { project, files, open } = useDocuments.getState();
  if (project === null) return;
  const others = othersOf(usePeople.getState()).map(({ file, head }) => [file, head]); // who moves the caret may type
  const now = JSON.stringify([
    project,
    files.map(({ path, version }) => `${path} ${version}`),
    Object.keys(open),
    others,
  ]);
  if (now === known) return;
  known = now;
  refreshSoon();
}
useDocuments.subscribe(follow);
usePeople.subscribe(follow);
