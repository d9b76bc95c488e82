/** Cross references: who reads and who writes a variable, and what nobody reads; kept up to date while the texts are edited. */

import type { Range } from "vscode-languageserver-types";
import { create } from "zustand";
import { messageOf } from "../../logic/format/messageOf";
import { t } from "../../text";
import { openPage } from "../page/navigate";
import { onInstanceChange } from "../plc/reset";
import { useDocuments } from "./documents";

interface Place {
  file: string;
  line: number;
  column: number;
}

export interface CrossReference extends Place {
  access: "declared" | "read" | "written" | "named";
  /** The POU around it, with the method; empty outside of any. */
  pou: string;
  /** Its line. */
  text: string;
}

export interface Unused extends Place {
  name: string;
  /** It is written, and never read. */
  written: boolean;
  pou: string;
}

interface Cross {
  /** Null: the page lists what nobody reads. */
  name: string | null;
  /** The variable of the PLC that was asked about, where there is one. */
  path: string | null;
  references: readonly CrossReference[];
  unused: readonly Unused[];
  /** False: the program has errors, so names in some statements are not known. */
  complete: boolean;
  state: "asking" | "there" | "nothing";
  trouble: string | null;
}

const nothing: Cross = {
  name: null,
  path: null,
  references: [],
  unused: [],
  complete: true,
  state: "asking",
  trouble: null,
};

export const useCross = create<Cross>(() => nothing);
const set = useCross.setState;

type Wanted = { path: string } | { symbol: readonly string[] } | Place;

interface Told {
  uri: string;
  range: Range;
}
interface Answer {
  name: string;
  /** Null: nothing is meant. */
  symbol: string[] | null;
  complete: boolean;
  references: (Told & Pick<CrossReference, "access" | "pou" | "text">)[];
}

/** The symbol that is shown, by which it is asked for again; null: what nobody reads. */
let symbol: readonly string[] | null = null;
let shown = false;
let turn = 0;

/** Of the name at a place of a text; `path` is the variable of the PLC that it is there. */
export async function showCrossReferences(at: Place, path: string | null): Promise<void> {
  symbol = null;
  openPage("cross");
  set({ ...nothing, name: "", path });
  await askFor(at);
}

/** Of a variable of the PLC, by its instance path. */
export async function showCrossReferencesOf(path: string): Promise<void> {
  symbol = null;
  openPage("cross");
  set({ ...nothing, name: path, path });
  await askFor({ path });
}

export async function showUnused(): Promise<void> {
  openPage("cross");
  symbol = null;
  set(nothing);
  await askUnused();
}

/** The page is in sight: what it shows follows the texts from now on, until the returned function is called. */
export function followTexts(): () => void {
  shown = true;
  again();
  return () => {
    shown = false;
  };
}

function again(): void {
  if (symbol !== null) void askFor({ symbol });
  else if (useCross.getState().name === null) void askUnused();
}

async function askFor(wanted: Wanted): Promise<void> {
  await answered(async () => {
    const { ask, askAt } = await import("./language");
    const answer =
      "file" in wanted ? await askAt<Answer>(CROSS, wanted.file, wanted) : await ask<Answer>(CROSS, wanted);
    if (!answer) throw new Error(t("cross.unanswered"));
    const { complete, references } = answer;
    const gone = references.length === 0 && "symbol" in wanted;
    if (answer.symbol === null || gone) return { complete, state: "nothing" as const, references: [] };
    const name = answer.name || useCross.getState().name;
    return { name, complete, state: "there" as const, references: await placed(references), of: answer.symbol };
  });
}

async function askUnused(): Promise<void> {
  await answered(async () => {
    const { ask } = await import("./language");
    const answer = await ask<{ complete: boolean; unused: (Told & Pick<Unused, "name" | "written" | "pou">)[] }>(
      UNUSED,
      {},
    );
    if (!answer) throw new Error(t("cross.unanswered"));
    return { state: "there" as const, complete: answer.complete, unused: await placed(answer.unused) };
  });
}

/** What an answer says; one that comes after a later question is dropped. */
async function answered(ask: () => Promise<Partial<Cross> & { of?: readonly string[] }>): Promise<void> {
  turn += 1;
  const mine = turn;
  try {
    const { of, ...said } = await ask();
    if (mine !== turn) return;
    if (of) symbol = of;
    set({ ...said, trouble: null });
  } catch (error) {
    if (mine === turn) set({ trouble: messageOf(error), references: [], unused: [], state: "asking" });
  }
}

async function placed<T extends Told>(told: readonly T[]): Promise<(Omit<T, keyof Told> & Place)[]> {
  const { pathOf } = await import("./language");
  return told.map(({ uri, range: { start }, ...more }) => ({
    ...more,
    file: pathOf(uri),
    line: start.line + 1,
    column: start.character + 1,
  }));
}

const CROSS = "scanbench/crossReferences";
const UNUSED = "scanbench/unused";

onInstanceChange(({ otherProject }) => {
  if (!otherProject) return;
  turn += 1;
  symbol = null;
  set(nothing);
});

// Each check of the texts may have changed who reads and who writes.
useDocuments.subscribe((now, before) => {
  if (shown && now.problems !== before.problems) again();
});
