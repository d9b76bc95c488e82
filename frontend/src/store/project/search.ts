/** Search in all files of the project: in the texts as people edit them now. */
import { create } from "zustand";
import { isPanelFile } from "../../logic/project/panelFiles";
import { type Match, matches, pattern, replaced, replacement, type Wanted } from "../../logic/project/search";
import { openFile, showPanel } from "../page/navigate";
import { edit, openDocument, textHere, useDocuments } from "./documents";
import SearchWorker from "./search.worker?worker";
import { type FileMatches, type Question, searcher } from "./searching";
import { textsNow } from "./textsNow";
import { useUnsaved } from "./unsaved";

interface Search extends Wanted {
  /** What replaces it, as typed. */
  by: string;
  found: readonly FileMatches[];
  /** Files whose text the server did not give. */
  unread: readonly string[];
  /** The expression is none. */
  bad: boolean;
  /** The expression took so long that the search was ended. */
  slow: boolean;
  /** How often somebody asked for the field by a key. */
  asked: number;
}

export const useSearch = create<Search>(() => ({
  text: "",
  cased: false,
  whole: false,
  regex: false,
  by: "",
  found: [],
  unread: [],
  bad: false,
  slow: false,
  asked: 0,
}));

const get = useSearch.getState;
const set = useSearch.setState;

let turn = 0;
/** While somebody types, the list follows a moment later. */
const QUIET_MS = 150;
let soon: ReturnType<typeof setTimeout> | undefined;
let replacing = false;

/** Ctrl+Shift+F. */
export function askSearch(): void {
  showPanel("search");
  set(({ asked }) => ({ asked: asked + 1 }));
}

export function look(change: Partial<Wanted>): void {
  set(change);
  searchSoon();
}

export const replaceBy = (by: string) => set({ by });

function searchSoon(): void {
  clearTimeout(soon);
  soon = setTimeout(() => void search(), QUIET_MS);
}

/** Looks through all files; a later call makes an earlier one void. */
async function search(): Promise<void> {
  turn += 1;
  const mine = turn;
  const wanted = get().text === "" ? null : pattern(get());
  if (!wanted) return set({ found: [], unread: [], bad: get().text !== "", slow: false });
  const { files, open } = useDocuments.getState();
  const programs = files.filter(({ path }) => !isPanelFile(path));
  const listed = new Set(programs.map(({ path }) => path));
  // A file that somebody deleted is still here while it is open.
  const searched = [...programs, ...Object.values(open).filter(({ path }) => !listed.has(path))];
  const now = await textsNow(searched).catch(() => new Map(searched.map(({ path }) => [path, textHere(path)])));
  if (mine !== turn) return;
  const texts: { path: string; text: string }[] = [];
  const unread: string[] = [];
  for (const [path, text] of now) {
    if (text === null) unread.push(path);
    else texts.push({ path, text });
  }
  const found = await findIn(forList, wanted, texts);
  if (mine === turn) set({ found: found ?? [], unread, bad: false, slow: found === null });
}

type Ask = ReturnType<typeof searcher>;
/** A search ends the one before, but no replacement. */
const forList = searcher(() => new SearchWorker());
const forReplacement = searcher(() => new SearchWorker());

/** The matches in some texts; null where the expression takes too long. A plain text is found at once, here. */
async function findIn(ask: Ask, wanted: RegExp, texts: Question["texts"]): Promise<FileMatches[] | null> {
  const { text, cased, whole, regex } = get();
  if (regex) return ask({ wanted: { text, cased, whole, regex }, texts });
  return texts
    .map(({ path, text: inFile }) => ({ path, matches: matches(inFile, wanted) }))
    .filter(({ matches: found }) => found.length > 0);
}

/** What a match becomes. */
export const becomes = (match: Match) => replacement(match, get().by, get().regex);

/** Replaces one match, or all of a file, or all. The files are opened and not saved: the editor takes it back by Ctrl+Z. */
export async function replace(which: readonly FileMatches[]): Promise<void> {
  const { by, regex } = get();
  const wanted = pattern(get());
  if (replacing || !wanted) return;
  replacing = true;
  try {
    for (const { path, matches: some } of which) {
      await openDocument(path).catch(() => undefined); // it is gone, or nobody answers: the search afterwards tells it
      const document = useDocuments.getState().open[path];
      if (!document) continue;
      openFile(path);
      // The text may have changed since the search: only what is still there is replaced.
      const known = new Set(some.map(({ at, length }) => `${at} ${length}`));
      const now = await findIn(forReplacement, wanted, [{ path, text: document.text }]);
      if (useDocuments.getState().open[path]?.text !== document.text) continue; // somebody typed meanwhile
      const still = (now?.[0]?.matches ?? []).filter(({ at, length }) => known.has(`${at} ${length}`));
      edit(
        path,
        replaced(document.text, still, (match) => replacement(match, by, regex)),
      );
    }
    await search();
  } finally {
    replacing = false;
  }
}

useDocuments.subscribe((now, before) => {
  if (now.project !== before.project) {
    turn += 1; // what still comes is of the other project
    set({ found: [], unread: [] });
  }
  if (get().text !== "" && (now.open !== before.open || now.files !== before.files)) searchSoon();
});

/** Somebody began to edit a file that is not open here, or saved it. */
useUnsaved.subscribe(() => {
  if (get().text !== "") searchSoon();
});
