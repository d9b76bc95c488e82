/** Versions of the program: what was built, compared with each other and with the texts as they are now. */
import { create } from "zustand";
import { messageOf } from "../../logic/format/messageOf";
import { isPanelFile } from "../../logic/project/panelFiles";
import { type Difference, differences } from "../../logic/project/versions";
import { rest } from "../../wire/rest";
import type { ProjectVersion } from "../../wire/types";
import { openFile, openPage } from "../page/navigate";
import { createFile, edit, openDocument, textHere, useDocuments } from "./documents";
import { savedText } from "./sourceText";

/** A version by its number, or the texts as they are edited here. */
export type Side = number | "now";

interface Versions {
  all: readonly ProjectVersion[];
  before: Side;
  after: Side;
  /** Null while the texts are being loaded. */
  found: readonly Difference[] | null;
  chosen: string | null;
  trouble: string | null;
}

const nothing: Versions = { all: [], before: "now", after: "now", found: null, chosen: null, trouble: null };

export const useVersions = create<Versions>(() => nothing);

const get = useVersions.getState;
const set = useVersions.setState;
const texts = new Map<number, Readonly<Record<string, string>>>();
let turn = 0;

/** Shows what is different now from the last version that was built. */
export async function openVersions(): Promise<void> {
  openPage("versions");
  await guarded(async () => {
    const { project } = useDocuments.getState();
    if (project === null) return;
    const all = await rest.versions(project);
    set({ all, before: all[0]?.version ?? "now", after: "now" });
    await compare();
  });
}

export function choose(change: Partial<Pick<Versions, "before" | "after" | "chosen">>): void {
  set(change);
  if (change.before !== undefined || change.after !== undefined) void guarded(compare);
}

async function compare(): Promise<void> {
  turn += 1;
  const mine = turn;
  const { before, after } = get();
  set({ found: null, trouble: null });
  const [one, other] = [await textsOf(before), await textsOf(after)];
  if (mine !== turn) return;
  const found = differences(one, other);
  const { chosen } = get();
  set({ found, chosen: found.some(({ path }) => path === chosen) ? chosen : (found[0]?.path ?? null) });
}

async function textsOf(side: Side): Promise<Readonly<Record<string, string>>> {
  const { project, files } = useDocuments.getState();
  if (project === null) return {};
  if (side !== "now") {
    const known = texts.get(side) ?? (await rest.version(project, side)).files;
    if (useDocuments.getState().project === project) texts.set(side, known);
    return known;
  }
  const now: Record<string, string> = {};
  for (const { path } of files) {
    if (isPanelFile(path)) continue; // no build has it
    const text = textHere(path) ?? (await savedText(path));
    if (text === null) throw new Error(path);
    now[path] = text;
  }
  return now;
}

/** Takes the texts of a version into the editor, where they are not saved yet; a file that is missing is made again. */
export const takeVersion = (version: number) =>
  guarded(async () => {
    for (const { path, before } of differences(await textsOf(version), await textsOf("now"))) {
      if (before === null) continue; // that version has no such file: it stays
      if (!useDocuments.getState().files.some((file) => file.path === path)) {
        await createFile(path, before);
        continue;
      }
      await openDocument(path);
      openFile(path);
      edit(path, before);
    }
    openPage("versions");
    await compare();
  });

async function guarded(deed: () => Promise<void>): Promise<void> {
  try {
    await deed();
  } catch (error) {
    set({ trouble: messageOf(error) });
  }
}

useDocuments.subscribe(({ project }, before) => {
  if (project === before.project) return;
  texts.clear();
  set(nothing);
});
