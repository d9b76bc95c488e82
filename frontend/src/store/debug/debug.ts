/** The debugger of this PLC, which everybody shares: breakpoints, and the debug session of this browser. */

import { create } from "zustand";
import type { Wanted } from "../../logic/debug/breakpoints";
import { isShared, PLAIN } from "../../logic/debug/breakpoints";
import { t } from "../../text";
import { type DebugProtocol, dap } from "../../wire/dap";
import type { BreakpointInfo } from "../../wire/types";
import { onInstanceChange } from "../plc/reset";

export type Access = BreakpointInfo["access"];

interface Debug {
  /** Of all groups, in the order in which they were made. */
  breakpoints: readonly BreakpointInfo[];
  /** The place of the form that is open in the editor; null while none is open. */
  editing: Editing | null;
  /** Why the last request to the debugger was refused. */
  refused: string | null;
}

export interface Editing {
  file: string;
  /** The line in the shown text. */
  line: number;
  wanted: Wanted;
  /** The breakpoint to change; null makes a new one. */
  id: number | null;
  /** What the breakpoint does when it is hit; decides which field the form shows. */
  does: "halt" | "log" | "assign";
}

export const useDebug = create<Debug>(() => ({ breakpoints: [], editing: null, refused: null }));
const get = useDebug.getState;
const set = useDebug.setState;

/** After each connection: begins a debug session, with the breakpoints that all browsers share. */
export function joinDebugger(breakpoints: readonly BreakpointInfo[]): void {
  set({ breakpoints, refused: null });
  const hello: DebugProtocol.InitializeRequestArguments = {
    adapterID: "scanbench",
    clientID: "browser",
    pathFormat: "path",
    linesStartAt1: true,
    columnsStartAt1: true,
    supportsInvalidatedEvent: true,
  };
  void ask("initialize", hello);
}

onInstanceChange(() => set({ breakpoints: [], editing: null, refused: null }));

export function onBreakpoints(breakpoints: readonly BreakpointInfo[]): void {
  set({ breakpoints });
}

/** A request whose refusal is shown in the status bar, as long as it is `wanted`; the result is null when it was refused. */
export async function ask<T = object>(command: string, args: object = {}, wanted = () => true): Promise<T | null> {
  try {
    const body = (await dap.request<T | undefined>(command, args)) ?? ({} as T);
    if (get().refused !== null) set({ refused: null });
    return body;
  } catch (error) {
    if (wanted()) set({ refused: reasonOf(error) });
    return null;
  }
}

export const reasonOf = (error: unknown) => (error instanceof Error && error.message ? error.message : t("notsent"));

interface Set {
  id: number | null;
  /** Why it can never halt. */
  trouble: string | null;
}

/** Adds a breakpoint to the shared list, or changes the one with this id. Throws the reason of a refusal. */
export async function setBreakpoint(wanted: Wanted, id: number | null = null): Promise<Set> {
  const { file, ...rest } = wanted;
  const breakpoint = { ...rest, source: { path: file }, ...(id === null ? {} : { id }) };
  const body = await dap.request<{ breakpoint: DebugProtocol.Breakpoint }>("scanbench/setBreakpoint", { breakpoint });
  set({ refused: null });
  const { verified, message, id: known } = body.breakpoint;
  // A disabled breakpoint needs no statement.
  return { id: known ?? id, trouble: verified || !wanted.enabled ? null : (message ?? null) };
}

/** The same without an open form; a refusal is shown in the status bar. */
export async function addBreakpoint(wanted: Partial<Wanted>, id: number | null = null): Promise<void> {
  try {
    await setBreakpoint({ ...PLAIN, ...wanted }, id);
  } catch (error) {
    set({ refused: reasonOf(error) });
  }
}

/** "Break when this is written, changed, read." */
export function addDataBreakpoint(path: string, access: Access): Promise<void> {
  return addBreakpoint({ kind: "data", path, access });
}

/** "Break when this error is raised"; empty is any. */
export function addErrorBreakpoint(error: string): Promise<void> {
  return addBreakpoint({ kind: "error", error });
}

export async function removeBreakpoints(ids?: readonly number[]): Promise<void> {
  await ask("scanbench/removeBreakpoints", ids ? { ids } : {});
}

export async function enableBreakpoints(enabled: boolean, ids?: readonly number[]): Promise<void> {
  await ask("scanbench/enableBreakpoints", { enabled, ...(ids ? { ids } : {}) });
}

/** The shared line breakpoints at a line of the built text. */
export function breakpointsAt(file: string, line: number): BreakpointInfo[] {
  return get().breakpoints.filter(
    (known) =>
      isShared(known) &&
      known.kind === "line" &&
      known.file === file &&
      // A breakpoint that was moved to a statement is found at its line, and at the line where it was set.
      (known.at_line || known.line) === line,
  );
}

/** A click on the gutter, F9: removes the breakpoints of the line, or sets a plain one; with a column those of one statement. */
export async function toggleBreakpoint(file: string, line: number, column = 0): Promise<void> {
  const here = breakpointsAt(file, line).filter(({ at_column }) => column === 0 || at_column === column);
  if (here.length > 0) await removeBreakpoints(here.map(({ id }) => id));
  else await addBreakpoint({ file, line, column });
}

/** After a build by this browser: breakpoints move with the text. Those without a column are at the first statement of their line. */
export async function moveBreakpoints(
  file: string,
  places: ReadonlyMap<number, { line: number; column?: number }>,
): Promise<void> {
  for (const known of get().breakpoints) {
    const { line = known.line, column = known.column } = places.get(known.id) ?? {};
    if (!isShared(known) || known.file !== file || (known.line === line && known.column === column)) continue;
    await addBreakpoint({ ...wantedOf(known), line, column }, known.id);
  }
}

/** The properties of a breakpoint that a person chose, without the server's results. */
export function wantedOf(known: BreakpointInfo): Wanted {
  const { kind, enabled, file, line, column, path, access, error, scan, condition, hits, log, assign, instance, task } =
    known;
  return { kind, enabled, file, line, column, path, access, error, scan, condition, hits, log, assign, instance, task };
}

export function editBreakpoint(editing: Editing | null): void {
  set({ editing });
}
