/** The operator panels that are open: read from files of the project, and saved with every change. Simultaneous changes of two
 * people are merged; no change is lost. */

import { create } from "zustand";
import { messageOf } from "../../logic/format/messageOf";
import {
  EMPTY_PANEL,
  mergePanels,
  type Panel,
  parsePanel,
  samePanel,
  textOf,
  type Wrong,
} from "../../logic/operator/panel";
import { t } from "../../text";
import { rest } from "../../wire/rest";
import type { FileInfo } from "../../wire/types";
import { forget, keep, recall } from "../page/localStorage";
import { openFile } from "../page/navigate";
import { usePlc } from "../plc/plc";
import { onInstanceChange } from "../plc/reset";
import { createFile, useDocuments } from "../project/documents";

interface Open {
  /** The version on the server that `base` is; 0 while it is not loaded. */
  version: number;
  base: Panel;
  panel: Panel;
  /** Why the file shows no panel now; `base` and `panel` are the last ones that it showed. */
  wrong: Wrong | null;
  /** Why it is not loaded, or not saved. */
  trouble: string | null;
  /** The browser holds what is not saved; its storage may be full or switched off. */
  kept: boolean;
}

interface OperatorPanels {
  open: Readonly<Record<string, Open>>;
  /** The page asks for the name of a new panel. */
  asking: boolean;
}

/** What was not saved at the last visit, and what it was made from. */
interface Draft {
  base: Panel;
  panel: Panel;
}

export const useOperatorPanels = create<OperatorPanels>(() => ({ open: {}, asking: false }));
const get = useOperatorPanels.getState;

const HISTORY = 100;
const RETRY_MS = 5_000;
const history = new Map<string, { before: Panel; after: Panel }[]>();
/** Saves under way, by project and path: that of a project that was left ends beside that of the shown one. */
const saving = new Map<string, Promise<void>>();
let retry: ReturnType<typeof setTimeout> | undefined;

const shownProject = () => useDocuments.getState().project;
const draftKey = (project: number, path: string) => `panel.${project}.${path}`;

function patch(path: string, change: Partial<Open>): void {
  useOperatorPanels.setState(({ open }) => {
    const known = open[path];
    return known ? { open: { ...open, [path]: { ...known, ...change } } } : {};
  });
}

function show(path: string, opened: Open): void {
  useOperatorPanels.setState(({ open }) => ({ open: { ...open, [path]: opened } }));
}

onInstanceChange(({ otherProject }) => {
  if (!otherProject) return;
  clearTimeout(retry);
  history.clear();
  useOperatorPanels.setState({ open: {} });
});

/** Reads a panel; changes that could not be saved at the last visit are saved now. */
export async function openPanel(path: string): Promise<void> {
  const project = shownProject();
  if (project === null || (get().open[path]?.version ?? 0) > 0) return;
  const nothing = { version: 0, base: EMPTY_PANEL, panel: EMPTY_PANEL, wrong: null, trouble: null, kept: true };
  try {
    const { text, version } = await rest.file(project, path);
    if (shownProject() !== project || (get().open[path]?.version ?? 0) > 0) return;
    const read = parsePanel(text);
    const draft = recall<Draft | null>(draftKey(project, path), null);
    if ("why" in read) show(path, { ...nothing, version, wrong: read, ...draft });
    else show(path, { ...nothing, version, base: read, panel: draft ? merged(draft, read) : read });
    await save(path);
  } catch (error) {
    if (shownProject() === project) show(path, { ...nothing, trouble: messageOf(error) });
  }
}

const merged = ({ base, panel }: Draft, theirs: Panel) => mergePanels(base, panel, theirs);

export const askNewPanel = (asking: boolean) => useOperatorPanels.setState({ asking });

/** Makes a panel and opens it. Throws the server's refusal. */
export async function createPanel(path: string): Promise<void> {
  await createFile(path, textOf(EMPTY_PANEL));
  openFile(path);
}

/** Changes a panel; it is saved at once. */
export function editPanel(path: string, change: (panel: Panel) => Panel): void {
  const known = get().open[path];
  if (!known || known.wrong !== null) return;
  const panel = change(known.panel);
  if (samePanel(panel, known.panel)) return;
  history.set(path, [...(history.get(path) ?? []).slice(1 - HISTORY), { before: known.panel, after: panel }]);
  patch(path, { panel });
  void save(path);
}

export const canUndo = (path: string): boolean => (history.get(path)?.length ?? 0) > 0;

export function undoPanelEdit(path: string): void {
  const done = history.get(path)?.pop();
  const known = get().open[path];
  if (done === undefined || !known) return;
  patch(path, { panel: mergePanels(done.after, done.before, known.panel) }); // what others did since then stays
  void save(path);
}

/** A text that shows no panel is never overwritten. */
const isEdited = ({ panel, base, wrong }: Open) => wrong === null && !samePanel(panel, base);

/** Saves until there is nothing to save. The browser keeps what cannot be saved. */
function save(path: string): Promise<void> {
  const project = shownProject();
  const known = get().open[path];
  if (project === null || !known || !isEdited(known)) return Promise.resolve();
  keepDraft(project, path, known);
  const key = draftKey(project, path);
  const begun = saving.get(key) ?? saveAll(project, path).finally(() => saving.delete(key));
  saving.set(key, begun);
  return begun;
}

function keepDraft(project: number, path: string, { base, panel }: Open): void {
  patch(path, { kept: keep(draftKey(project, path), { base, panel } satisfies Draft) });
}

async function saveAll(project: number, path: string): Promise<void> {
  const shown = () => (shownProject() === project ? get().open[path] : undefined);
  try {
    for (let known = shown(); known && isEdited(known); known = shown()) {
      if (usePlc.getState().link.state === "lost") throw new Error(t("operator.unsaved"));
      keepDraft(project, path, known);
      await saveOnce(project, path, known);
    }
    if (shownProject() === project) patch(path, { trouble: null });
  } catch (error) {
    if (shownProject() !== project) return; // the draft is saved when the project is shown again
    patch(path, { trouble: messageOf(error) });
    clearTimeout(retry);
    retry = setTimeout(() => void save(path), RETRY_MS);
  }
}

async function saveOnce(project: number, path: string, { panel, version }: Open): Promise<void> {
  const result = await rest.save(project, path, textOf(panel), version);
  if ("saved" in result) {
    const draft = recall<Draft | null>(draftKey(project, path), null);
    if (draft && samePanel(draft.panel, panel)) forget(draftKey(project, path));
  }
  if (shownProject() !== project) return;
  if ("saved" in result) patch(path, { base: panel, version: result.saved.version });
  else if (result.conflict.theirs.version === 0) onGone(path);
  else takeTheirs(path, result.conflict.theirs.text, result.conflict.theirs.version);
}

function takeTheirs(path: string, text: string, version: number): void {
  const known = get().open[path];
  if (!known) return;
  const read = parsePanel(text);
  if ("why" in read) patch(path, { wrong: read, version });
  else patch(path, { wrong: null, base: read, panel: merged(known, read), version });
}

async function pull(project: number, path: string): Promise<void> {
  const file = await rest.file(project, path);
  if (shownProject() === project) takeTheirs(path, file.text, file.version);
}

/** Somebody (perhaps this browser) saved a file. */
export async function onPanelSaved({ path, version }: FileInfo): Promise<void> {
  const project = shownProject();
  if (project === null) return;
  await saving.get(draftKey(project, path));
  if (shownProject() === project && (get().open[path]?.version ?? version) < version) await pull(project, path);
}

/** A panel of that name that comes later is a different one. */
function onGone(path: string): void {
  const project = shownProject();
  history.delete(path);
  if (project !== null) forget(draftKey(project, path));
  useOperatorPanels.setState(({ open: { [path]: _gone, ...open } }) => ({ open }));
}

useDocuments.subscribe((now, before) => {
  if (now.project !== before.project || now.files === before.files) return;
  const there = new Set(now.files.map(({ path }) => path));
  for (const path of Object.keys(get().open)) if (!there.has(path)) onGone(path);
});

/** After a connection: what others saved meanwhile, and what could not be saved or read here. */
export async function catchUpPanels(): Promise<void> {
  const project = shownProject();
  if (project === null || Object.keys(get().open).length === 0) return;
  try {
    for (const { path, version } of await rest.files(project)) {
      const known = get().open[path];
      if (shownProject() !== project || !known) continue;
      if (known.version === 0) await openPanel(path);
      else if (known.version !== version && !saving.has(draftKey(project, path))) await pull(project, path);
    }
  } catch {
    return; // the connection was lost again: the next one catches up
  }
  for (const path of Object.keys(get().open)) void save(path);
}
