/** The memory view: which area it shows and how, what its words are called, and what was looked for. */
import { create } from "zustand";
import { messageOf } from "../../logic/format/messageOf";
import { type FindBits, MEMORY_FORMATS, type MemoryFormat, numberOf } from "../../logic/watch/memory";
import { t } from "../../text";
import { rest } from "../../wire/rest";
import { send } from "../../wire/send";
import type { MemoryWord } from "../../wire/types";
import { keep, recall } from "../page/localStorage";
import { openPage } from "../page/navigate";
import { useBench } from "../plc/bench";
import { usePlc } from "../plc/plc";
import { onInstanceChange } from "../plc/reset";

interface Memory {
  /** Null until one is chosen: then it is the first of the model. */
  area: string | null;
  format: MemoryFormat;
  /** The selected word, by its number in the area. */
  selected: number;
  /** What is known of the words: of each area in blocks. */
  blocks: ReadonlyMap<string, readonly MemoryWord[]>;
  /** Why something could not be read, written or found. */
  trouble: string | null;
  /** What a search found. */
  found: string | null;
}

const KEPT = "memory";
const kept = recall<{ area: string; format: string }>(KEPT, { area: "", format: "hex" });

const nothing = { selected: 0, blocks: new Map(), trouble: null, found: null };

export const useMemory = create<Memory>(() => ({
  ...nothing,
  area: kept.area || null,
  format: MEMORY_FORMATS.find((known) => known === kept.format) ?? "hex",
}));

const get = useMemory.getState;
const set = useMemory.setState;

onInstanceChange(() => {
  turn += 1;
  going += 1;
  asked.clear();
  set(nothing);
});

/** The words of a block: what is asked of the server at once. */
const BLOCK = 500;

/** Grows with everything that makes answers out of date. */
let turn = 0;
const asked = new Set<string>();

const blockOf = (area: string, index: number) => `${area} ${Math.floor(index / BLOCK)}`;

/** A word by its number in its area; undefined while nothing is known of it. */
export const wordIn = (blocks: Memory["blocks"], area: string, index: number): MemoryWord | undefined =>
  blocks.get(blockOf(area, index))?.[index % BLOCK];

export function showArea(area: string): void {
  going += 1;
  set({ area, selected: 0, trouble: null, found: null });
  keep(KEPT, { area, format: get().format });
}

/** The area that is looked at is not there: this one is shown, until an address that was asked for is found. */
export function fallBackTo(area: string): void {
  set({ area, selected: 0 });
}

export function showFormat(format: MemoryFormat): void {
  set({ format });
  keep(KEPT, { area: get().area ?? "", format });
}

export function selectWord(selected: number): void {
  going += 1;
  set({ selected, trouble: null });
}

/** Why nothing can be done now. */
export const complain = (trouble: string) => set({ trouble });

/** A different program may have other variables in the same words. */
export function forgetNames(): void {
  turn += 1;
  asked.clear();
  set({ blocks: new Map() });
}

/** Asks for what is not known of these words. */
export async function loadWords(area: string, from: number, to: number): Promise<void> {
  const first = Math.floor(from / BLOCK);
  const count = Math.floor((to - 1) / BLOCK) - first + 1;
  await Promise.all(Array.from({ length: count }, (_, at) => loadBlock(area, (first + at) * BLOCK)));
}

async function loadBlock(area: string, first: number): Promise<void> {
  const block = blockOf(area, first);
  const instance = useBench.getState().instance?.id;
  if (instance === undefined || asked.has(block)) return;
  asked.add(block);
  const mine = turn;
  try {
    const words = await rest.memoryWords(instance, area, first, BLOCK);
    if (mine === turn) set(({ blocks }) => ({ blocks: new Map(blocks).set(block, words), trouble: null }));
  } catch (error) {
    if (mine !== turn) return;
    asked.delete(block);
    set({ trouble: t("memory.trouble", { message: messageOf(error) }) });
  }
}

/** Opens the page at an address, or at a variable that has one. */
export async function showInMemory(path: string): Promise<void> {
  openPage("memory");
  await goToAddress(path);
}

/** Grows with every choice of a word: an answer to an earlier one is late. */
let going = 0;

export async function goToAddress(path: string): Promise<void> {
  const instance = useBench.getState().instance?.id;
  if (instance === undefined || path.trim() === "") return;
  going += 1;
  const mine = going;
  try {
    const { area, word } = await rest.memoryPlace(instance, path);
    if (mine !== going) return;
    if (area !== get().area) showArea(area);
    set({ selected: word, trouble: null, found: null });
  } catch (error) {
    if (mine === going) set({ trouble: messageOf(error) });
  }
}

/** Selects the next word at which the value begins, from the selected one on; after the last one from the start again. */
export async function findValue(area: string, typed: string, bits: FindBits): Promise<void> {
  const instance = useBench.getState().instance?.id;
  const value = numberOf(typed, get().format, bits);
  if (value === null)
    return set({ trouble: t("memory.notnumber", { text: typed, format: t(`format.${get().format}`) }), found: null });
  if (instance === undefined) return;
  going += 1;
  const mine = going;
  try {
    const next = get().selected + 1;
    const later = await rest.memoryFind(instance, area, value, bits, next);
    const answer = later.words.length > 0 ? later : await rest.memoryFind(instance, area, value, bits, 0);
    if (mine !== going) return;
    const [word] = answer.words;
    const halted = usePlc.getState().state?.halt != null;
    const when = halted ? t("memory.when.halt") : t("memory.when.scan", { scan: answer.scan });
    if (word === undefined) return set({ trouble: null, found: t("memory.none", { text: typed.trim(), area, when }) });
    set({ selected: word, trouble: null, found: t(word < next ? "memory.again" : "memory.found", { when }) });
  } catch (error) {
    if (mine === going) set({ trouble: messageOf(error), found: null });
  }
}

/** Writes a word. False when it was refused: the reason is shown. */
export async function writeWord(path: string, value: string): Promise<boolean> {
  const mine = turn;
  const answer = await send({ type: "write", path, value, site: "" });
  if (mine === turn) set({ trouble: answer.ok ? null : answer.message || t("operator.notsent") });
  return answer.ok;
}
