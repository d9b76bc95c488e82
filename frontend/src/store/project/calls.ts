/** The call tree of a POU or method: whom it calls, or who calls it, asked for level by level from the language server. */

import type {
  CallHierarchyIncomingCall,
  CallHierarchyItem,
  CallHierarchyOutgoingCall,
} from "vscode-languageserver-types";
import { create } from "zustand";
import { messageOf } from "../../logic/format/messageOf";
import { t } from "../../text";
import { openPage } from "../page/navigate";
import { onInstanceChange } from "../plc/reset";
import { useDocuments } from "./documents";

export type Direction = "calls" | "callers";

/** A POU or method in the tree. */
export interface Party {
  /** The same for the same POU, wherever it is in the tree. */
  id: string;
  name: string;
  /** As LSP numbers the kinds of symbols. */
  kind: number;
  file: string;
  line: number;
  item: CallHierarchyItem;
}

/** One that is called by the row above it, or calls that. */
export interface Called extends Party {
  /** Where the calls are. */
  places: readonly { file: string; line: number; column: number }[];
}

interface Calls {
  direction: Direction;
  root: Party | null;
  /** What is known below each party, by its id. */
  below: Readonly<Record<string, readonly Called[]>>;
  state: "asking" | "there" | "nothing";
  trouble: string | null;
}

const nothing: Calls = { direction: "calls", root: null, below: {}, state: "asking", trouble: null };

export const useCalls = create<Calls>(() => nothing);
const set = useCalls.setState;
const get = useCalls.getState;

/** Answers to questions of an earlier turn are dropped. */
let turn = 0;
let shown = false;

type Language = typeof import("./language");

/** Of what is named at a place of a text; of a variable, the block that it is an instance of. */
export async function showCalls(at: { file: string; line: number; column: number }): Promise<void> {
  openPage("calls");
  turn += 1;
  set({ ...nothing, direction: get().direction });
  await answered(async (language) => {
    const found = await language.askAt<CallHierarchyItem[]>("textDocument/prepareCallHierarchy", at.file, at);
    const [item] = found ?? [];
    if (!item) return { state: "nothing" };
    const root = partyOf(language, item);
    return { state: "there", root, below: await levels(language, [root]) };
  });
}

/** The other way round, from the same root. */
export function turnAround(direction: Direction): void {
  const { root } = get();
  set({ direction, below: {} });
  if (root) void askAgain([root]);
}

/** Asks what is below a party, where that is not known yet. */
export async function unfold(party: Party): Promise<void> {
  if (get().below[party.id]) return;
  await answered(async (language) => {
    const found = await levels(language, [party]);
    return { below: { ...get().below, ...found } };
  });
}

/** The page is in sight: it follows the texts from now on, until the returned function is called. */
export function followCalls(): () => void {
  shown = true;
  refresh();
  return () => {
    shown = false;
  };
}

function refresh(): void {
  const { root, below } = get();
  if (!root) return;
  const parties = new Map([root, ...Object.values(below).flat()].map((each) => [each.id, each]));
  void askAgain([...parties.values()].filter(({ id }) => below[id]));
}

async function askAgain(parties: readonly Party[]): Promise<void> {
  turn += 1;
  await answered(async (language) => ({ below: await levels(language, parties) }));
}

async function answered(ask: (language: Language) => Promise<Partial<Calls>>): Promise<void> {
  const mine = turn;
  try {
    const said = await ask(await import("./language"));
    if (mine === turn) set({ ...said, trouble: null });
  } catch (error) {
    if (mine === turn) set({ trouble: messageOf(error) });
  }
}

async function levels(language: Language, parties: readonly Party[]): Promise<Calls["below"]> {
  const { direction } = get();
  return Object.fromEntries(
    await Promise.all(parties.map(async (party) => [party.id, await level(language, party, direction)] as const)),
  );
}

async function level(language: Language, party: Party, direction: Direction): Promise<Called[]> {
  const method = `callHierarchy/${direction === "calls" ? "outgoing" : "incoming"}Calls`;
  const found = await language.ask<(CallHierarchyIncomingCall | CallHierarchyOutgoingCall)[]>(method, {
    item: party.item,
  });
  if (found === null) throw new Error(t("cross.unanswered"));
  return found.map((each) => {
    const other = partyOf(language, "to" in each ? each.to : each.from);
    const { file } = "to" in each ? party : other; // of the text that calls
    const places = each.fromRanges.map(({ start }) => ({ file, line: start.line + 1, column: start.character + 1 }));
    return { ...other, places };
  });
}

function partyOf({ pathOf }: Language, item: CallHierarchyItem): Party {
  const { name, kind, uri, selectionRange, data } = item;
  return { id: JSON.stringify(data), name, kind, file: pathOf(uri), line: selectionRange.start.line + 1, item };
}

onInstanceChange(({ otherProject }) => {
  if (!otherProject) return;
  turn += 1;
  set(nothing);
});

// Each check of the texts may have changed who calls whom.
useDocuments.subscribe((now, before) => {
  if (shown && now.problems !== before.problems) refresh();
});
