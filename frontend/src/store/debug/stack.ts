/** The call stack while the program is halted: frames, scopes and the variables in them. */

import { create } from "zustand";
import { type DebugProtocol, dap } from "../../wire/dap";
import { usePlc } from "../plc/plc";
import { onInstanceChange } from "../plc/reset";
import { ask, reasonOf, useDebug } from "./debug";

/** What this adapter sends about a frame beyond the protocol. */
export interface Frame extends DebugProtocol.StackFrame {
  scanbench?: { pou: string; instance: string; task: string };
}

export interface Variable extends DebugProtocol.Variable {
  scanbench?: { path: string; alias: string; address: string; writable: boolean };
}

interface Stack {
  frames: readonly Frame[];
  /** Id of the selected frame. */
  frame: number | null;
  scopes: readonly DebugProtocol.Scope[];
  /** By the key of a scope (its name) or of a variable below one (`VAR/belt[3]`). */
  below: ReadonlyMap<string, readonly Variable[]>;
  open: ReadonlySet<string>;
  /** Keys of variables whose value differs from that at the previous halt. */
  changed: ReadonlySet<string>;
  /** Why an entry was refused, by the key of its variable. */
  refused: ReadonlyMap<string, string>;
}

const nothing: Omit<Stack, "open"> = {
  frames: [],
  frame: null,
  scopes: [],
  below: new Map(),
  changed: new Set(),
  refused: new Map(),
};

/** More variables are shown page by page. */
const PAGE = 100;
const OPEN_AT_FIRST = ["VAR_INPUT", "VAR_OUTPUT", "VAR_IN_OUT", "VAR", "VAR_TEMP", "RESULT", "THIS"];

export const useStack = create<Stack>(() => ({ ...nothing, open: new Set(OPEN_AT_FIRST) }));
const get = useStack.getState;
const set = useStack.setState;

/** Counts readings, of a halt or of one of its frames: what an earlier one was still reading is dropped. */
let turn = 0;

/** Whether the present reading is still the last one. */
function present(): () => boolean {
  const mine = turn;
  return () => mine === turn;
}

/** A reading begins: the same of that. */
function reading(): () => boolean {
  turn += 1;
  return present();
}

/** The values of the previously shown frame, to find changes. */
let texts: ReadonlyMap<string, string> = new Map();
let textsOf = "";

function resetStack(): void {
  reading();
  texts = new Map();
  set(nothing);
}

onInstanceChange(resetStack);

dap.on("stopped", (body) => void load((body as DebugProtocol.StoppedEvent["body"]).threadId ?? 1));
dap.on("continued", resetWhileRunning);
dap.on("invalidated", () => void loadFrame());
dap.on("terminated", resetStack);

// The adapter does not send `continued` to the client that continues, and a run-time error ends a halt, too.
usePlc.subscribe(({ state: now }, { state: before }) => {
  if (before?.halt && !now?.halt) resetWhileRunning();
});

function resetWhileRunning(): void {
  reading();
  set(nothing);
  // What was refused of this halt means nothing any more.
  useDebug.setState({ refused: null });
}

async function load(threadId: number): Promise<void> {
  const wanted = reading();
  // The PLC may have halted again before the page knew: what was refused of the halt before means nothing any more.
  useDebug.setState({ refused: null });
  const body = await ask<DebugProtocol.StackTraceResponse["body"]>("stackTrace", { threadId, levels: 200 }, wanted);
  if (!wanted() || !body) return;
  const frames = body.stackFrames as Frame[];
  set({ ...nothing, frames, frame: frames[0]?.id ?? null });
  await loadFrame();
}

export function frameNow(): Frame | undefined {
  const { frames, frame } = get();
  return frames.find(({ id }) => id === frame);
}

export async function chooseFrame(id: number): Promise<void> {
  set({ frame: id });
  await loadFrame();
}

/** Fetches the scopes and their unfolded variables again. */
async function loadFrame(): Promise<void> {
  const wanted = reading();
  const { frame } = get();
  if (frame === null) return;
  const body = await ask<DebugProtocol.ScopesResponse["body"]>("scopes", { frameId: frame }, wanted);
  if (!wanted() || !body) return;
  const below = new Map<string, readonly Variable[]>();
  for (const scope of body.scopes) {
    if (get().open.has(scope.name)) await fill(below, scope.name, scope.variablesReference, wanted);
  }
  if (!wanted()) return;
  const name = frameNow()?.name ?? "";
  const now = textsIn(below);
  const changed = new Set(
    name === textsOf ? [...now].flatMap(([key, text]) => (differs(texts.get(key), text) ? [key] : [])) : [],
  );
  [texts, textsOf] = [now, name];
  set({ scopes: body.scopes, below, changed, refused: new Map() });
}

const differs = (before: string | undefined, now: string) => before !== undefined && before !== now;

/** Reads variables and what is unfolded below them, as long as that is `wanted`: a later halt knows nothing of these references. */
async function fill(
  below: Map<string, readonly Variable[]>,
  key: string,
  reference: number,
  wanted: () => boolean,
): Promise<void> {
  if (!wanted()) return;
  const variables = await fetchBelow(reference, 0, wanted);
  below.set(key, variables);
  for (const variable of variables) {
    const inner = keyOf(key, variable);
    if (variable.variablesReference > 0 && get().open.has(inner))
      await fill(below, inner, variable.variablesReference, wanted);
  }
}

async function fetchBelow(reference: number, start: number, wanted: () => boolean): Promise<readonly Variable[]> {
  const args = { variablesReference: reference, start, count: PAGE };
  const body = await ask<DebugProtocol.VariablesResponse["body"]>("variables", args, wanted);
  return (body?.variables as Variable[] | undefined) ?? [];
}

function textsIn(below: ReadonlyMap<string, readonly Variable[]>): Map<string, string> {
  return new Map([...below].flatMap(([key, all]) => all.map((each) => [keyOf(key, each), each.value] as const)));
}

export const keyOf = (above: string, variable: Variable) => `${above.split("/")[0]}/${nameOf(variable)}`;
const nameOf = (variable: Variable) => variable.evaluateName ?? variable.name;

/** The number of members; fewer may have been fetched. */
export const countOf = (variable: { namedVariables?: number; indexedVariables?: number }) =>
  (variable.namedVariables ?? 0) + (variable.indexedVariables ?? 0);

export async function toggleVariable(key: string, reference: number): Promise<void> {
  const open = new Set(get().open);
  if (open.delete(key)) {
    set({ open });
    return;
  }
  set({ open: open.add(key) });
  const wanted = present();
  const below = new Map(get().below);
  await fill(below, key, reference, wanted);
  if (wanted()) set(({ below: now }) => ({ below: new Map([...now, ...below]) }));
}

export async function moreBelow(key: string, reference: number): Promise<void> {
  const wanted = present();
  const known = get().below.get(key) ?? [];
  const more = await fetchBelow(reference, known.length, wanted);
  if (wanted()) set(({ below }) => ({ below: new Map(below).set(key, [...known, ...more]) }));
}

/** Writes the value of a variable of the frame. True when it was accepted; else the reason is shown in its row. */
export async function setVariable(key: string, variable: Variable, value: string): Promise<boolean> {
  const { frame } = get();
  try {
    await dap.request("setExpression", { expression: nameOf(variable), value, frameId: frame });
    await loadFrame();
    return true;
  } catch (error) {
    const refused = new Map(get().refused).set(key, reasonOf(error));
    set({ refused });
    return false;
  }
}

export function forgetEntry(key: string): void {
  const refused = new Map(get().refused);
  if (refused.delete(key)) set({ refused });
}

/** The text of a variable of the frame by its name as written; temporaries have no path. */
export function frameText(name: string): string | undefined {
  const wanted = name.toUpperCase();
  for (const scope of get().scopes) {
    if (scope.name === "GLOBAL") continue;
    const found = get()
      .below.get(scope.name)
      ?.find((variable) => variable.name.toUpperCase() === wanted);
    // The members say more than their number.
    if (found) return found.variablesReference > 0 ? undefined : found.value;
  }
  return undefined;
}
