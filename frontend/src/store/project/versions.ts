/** Versions of the program and commits: compared with each other and with the texts as they are now, described, taken back. */
import { create } from "zustand";
import { spaced } from "../../logic/format/debounce";
import { messageOf } from "../../logic/format/messageOf";
import { isPanelFile } from "../../logic/project/panelFiles";
import { commitOf, type Difference, differences, type Side } from "../../logic/project/versions";
import { t } from "../../text";
import { git } from "../../wire/git";
import { rest } from "../../wire/rest";
import type { GitCommit, GitStatus, ProjectVersion } from "../../wire/types";
import { openFile, openPage } from "../page/navigate";
import { createFile, edit, openDocument, useDocuments } from "./documents";
import { othersOf, usePeople } from "./people";
import { textsNow } from "./textsNow";
import { saveAll, useUnsaved } from "./unsaved";

interface Versions {
  all: readonly ProjectVersion[];
  commits: readonly GitCommit[];
  /** Null until the server answered. */
  git: GitStatus | null;
  before: Side;
  after: Side;
  /** Null while the texts are being loaded. */
  found: readonly Difference[] | null;
  chosen: string | null;
  trouble: string | null;
}

const nothing: Versions = {
  all: [],
  commits: [],
  git: null,
  before: "now",
  after: "now",
  found: null,
  chosen: null,
  trouble: null,
};

export const useVersions = create<Versions>(() => nothing);

const get = useVersions.getState;
const set = useVersions.setState;
type Texts = Readonly<Record<string, string>>;
const texts = new Map<Side, Texts>();
let turn = 0;
let asked = 0;

/** Shows what is different now from the last version that was built. */
export async function openVersions(): Promise<void> {
  openPage("versions");
  await guarded(async () => {
    await refresh();
    set({ before: get().all[0]?.version ?? "now", after: "now", found: null });
    await compare();
  });
}

let shown = false;

/** The page is in sight: it follows what is edited, saved and built, until the returned function is called. */
export function followVersions(): () => void {
  shown = true;
  void guarded(async () => {
    await refresh();
    const { before, after, all } = get();
    if (before === "now" && after === "now") set({ before: all[0]?.version ?? "now" });
    await compare();
  });
  return () => {
    shown = false;
  };
}

async function refresh(): Promise<void> {
  const { project } = useDocuments.getState();
  if (project === null) return;
  asked += 1;
  const mine = asked;
  const [all, status] = await Promise.all([rest.versions(project), git.status(project)]);
  const commits = status.head ? await git.commits(project) : [];
  // An answer to an older question may come later.
  if (mine === asked && useDocuments.getState().project === project) set({ all, git: status, commits });
}

export function choose(change: Partial<Pick<Versions, "before" | "after" | "chosen">>): void {
  set(change.before === undefined && change.after === undefined ? change : { ...change, found: null });
  if (change.before !== undefined || change.after !== undefined) void guarded(compare);
}

async function compare(): Promise<void> {
  turn += 1;
  const mine = turn;
  const { before, after } = get();
  set({ trouble: null });
  // No build has the operator panels; a commit does.
  const withPanels = typeof before !== "number" && typeof after !== "number";
  const [one, other] = [await textsOf(before, withPanels), await textsOf(after, withPanels)];
  if (mine !== turn) return;
  const found = differences(one, other);
  const { chosen } = get();
  set({ found, chosen: found.some(({ path }) => path === chosen) ? chosen : (found[0]?.path ?? null) });
}

async function textsOf(side: Side, withPanels: boolean): Promise<Texts> {
  const { project, files } = useDocuments.getState();
  if (project === null) return {};
  if (side !== "now") {
    const known = texts.get(side) ?? (await storedTexts(project, side));
    if (useDocuments.getState().project === project) texts.set(side, known);
    return withPanels ? known : Object.fromEntries(Object.entries(known).filter(([path]) => !isPanelFile(path)));
  }
  const now: Record<string, string> = {};
  for (const [path, text] of await textsNow(files.filter(({ path }) => withPanels || !isPanelFile(path)))) {
    if (text === null) throw new Error(path);
    now[path] = text;
  }
  return now;
}

async function storedTexts(project: number, side: Exclude<Side, "now">): Promise<Texts> {
  if (typeof side === "number") return (await rest.version(project, side)).files;
  return (await git.commit(project, commitOf(side))).files;
}

/**
 * Takes the texts of a version or commit into the editor, or only the one of a file: they are not saved yet. A file that is
 * missing is made again. An operator panel is saved at once, as panels always are.
 */
export const takeVersion = (side: Exclude<Side, "now">, only: string | null = null) =>
  guarded(async () => {
    const withPanels = typeof side !== "number";
    for (const { path, before } of differences(await textsOf(side, withPanels), await textsOf("now", withPanels))) {
      if (before === null || (only !== null && path !== only)) continue; // that version has no such file: it stays
      if (!useDocuments.getState().files.some((file) => file.path === path)) await createFile(path, before);
      else if (isPanelFile(path)) await savePanel(path, before);
      else {
        await openDocument(path);
        openFile(path);
        edit(path, before);
      }
    }
    openPage("versions");
    await compare();
  });

async function savePanel(path: string, text: string): Promise<void> {
  const { project, files } = useDocuments.getState();
  const version = files.find((file) => file.path === path)?.version;
  if (project === null || version === undefined) return;
  const result = await rest.save(project, path, text, version);
  if ("conflict" in result) throw new Error(result.conflict.message);
}

/** Gives a version a label and a message. Throws the server's refusal. */
export async function describeVersion(version: number, label: string, message: string): Promise<void> {
  const { project } = useDocuments.getState();
  if (project === null) return;
  const described = await rest.describeVersion(project, version, label, message);
  set({ all: get().all.map((each) => (each.version === version ? described : each)) });
}

/** Makes the project's folder under git. */
export const beginGit = () =>
  guarded(async () => {
    const { project } = useDocuments.getState();
    if (project !== null) set({ git: await git.begin(project), trouble: null });
  });

/** Saves everything, and commits it. Throws the server's refusal. */
export async function commitNow(message: string): Promise<void> {
  const { project } = useDocuments.getState();
  const { git: status } = get();
  if (project === null || status === null) return;
  try {
    const path = await saveAll();
    if (path !== null) throw new Error(t("git.unsaved", { path }));
    // Who sees which files another program committed, and commits all the same, has agreed.
    await git.commitNow(project, { message, head: status.head, agreed: status.elsewhere.length > 0 });
  } finally {
    await refresh();
  }
}

async function guarded(deed: () => Promise<void>): Promise<void> {
  try {
    await deed();
  } catch (error) {
    set({ trouble: messageOf(error) });
  }
}

const compareSoon = spaced(() => void guarded(compare), 300);
/** What is saved or built changes what a commit would keep, and the versions. */
const refreshSoon = spaced(() => void guarded(refresh), 300);
useDocuments.subscribe(({ project, files, open, build }, before) => {
  if (project !== before.project) {
    texts.clear();
    set(nothing);
    return;
  }
  if (!shown) return;
  if (files !== before.files || build !== before.build) refreshSoon();
  if (files !== before.files || open !== before.open) compareSoon();
});

/** Others edit files that are not open here: nothing but where they are tells it. */
const compareWithOthers = spaced(() => shown && void guarded(compare), 1000);
usePeople.subscribe((people) => {
  if (shown && othersOf(people).some(({ file }) => file !== null)) compareWithOthers();
});
useUnsaved.subscribe(() => shown && compareSoon());
