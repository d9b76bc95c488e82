/** What the code of an instance saw, requested again and again while a drawing of it is open; see `docs/ladder.md`. */

import { create } from "zustand";
import { rest } from "../../wire/rest";
import type { Flows } from "../../wire/types";
import { useBench } from "../plc/bench";
import { isAway } from "../plc/members";
import { usePlc } from "../plc/plc";
import { onInstanceChange } from "../plc/reset";
import { seenAsNow, useSeenAs } from "./seenAs";

/** Between two requests while the PLC runs, in ms. */
const AGAIN = 50;

interface FlowStore {
  /** By the name of a POU; null where nothing is known. */
  of: ReadonlyMap<string, Flows | null>;
  /** Which of several calls is shown, by the name of a POU; without one the last. */
  call: ReadonlyMap<string, number>;
}

export const useFlow = create<FlowStore>(() => ({ of: new Map(), call: new Map() }));

interface Lines {
  first: number;
  last: number;
}

interface Looking {
  lines: Set<Lines>;
  asking: boolean;
  /** What the PLC was like when it was asked last. */
  asked: string;
  timer: ReturnType<typeof setTimeout> | undefined;
}

const looking = new Map<string, Looking>();

/** Requests the flow through the lines of a POU of the built text, until the returned function is called. */
export function lookAtFlow(pou: string, lines: Lines): () => void {
  const known = looking.get(pou) ?? { lines: new Set(), asking: false, asked: "", timer: undefined };
  looking.set(pou, known);
  known.lines.add(lines);
  known.asked = "";
  // The rows of a drawing come one after the other: they are asked for together.
  known.timer ??= setTimeout(() => want(pou), 0);
  return () => {
    known.lines.delete(lines);
    if (known.lines.size > 0) return;
    clearTimeout(known.timer);
    looking.delete(pou);
    put(pou, null);
  };
}

export function chooseCall(pou: string, call: number): void {
  useFlow.setState(({ call: before }) => ({ call: new Map(before).set(pou, call) }));
  again(pou);
}

/** What an answer depends on; while the PLC runs it is always a different one. */
function present(pou: string): string {
  const { state, link } = usePlc.getState();
  const call = useFlow.getState().call.get(pou) ?? 0;
  const where = [state?.scan, state?.halt?.number, state?.past, state?.program_version, state?.state];
  return [useBench.getState().instance?.id, link.state, seenAsNow(pou), call, ...where].join(" ");
}

function again(pou: string): void {
  const known = looking.get(pou);
  if (known && !known.asking) {
    clearTimeout(known.timer);
    want(pou);
  }
}

function want(pou: string): void {
  const known = looking.get(pou);
  if (!known) return;
  known.timer = undefined;
  const now = present(pou);
  if (now === known.asked || document.visibilityState === "hidden") return;
  known.asked = now;
  known.asking = true;
  void ask(pou, known).finally(() => {
    known.asking = false;
    if (looking.get(pou) === known) known.timer ??= setTimeout(() => want(pou), AGAIN);
  });
}

async function ask(pou: string, { lines }: Looking): Promise<void> {
  const instance = useBench.getState().instance?.id;
  const path = seenAsNow(pou);
  if (instance === undefined || path === undefined || isAway()) return put(pou, null);
  const all = [...lines];
  const wanted = {
    ...{ pou, path, call: useFlow.getState().call.get(pou) ?? 0 },
    ...{ first: Math.min(...all.map(({ first }) => first)), last: Math.max(...all.map(({ last }) => last)) },
  };
  let found: Flows | null;
  try {
    found = await rest.flow(instance, wanted);
  } catch {
    found = null; // The drawing says that it shows what values tell.
  }
  if (looking.has(pou) && useBench.getState().instance?.id === instance && seenAsNow(pou) === path)
    put(pou, found && found.flows.length > 0 ? found : null);
}

function put(pou: string, flows: Flows | null): void {
  const { of } = useFlow.getState();
  if ((of.get(pou) ?? null) === flows) return;
  useFlow.setState({ of: new Map(of).set(pou, flows) });
}

onInstanceChange(() => useFlow.setState({ of: new Map(), call: new Map() }));

const all = () => {
  for (const [pou, { timer }] of looking) if (timer === undefined) again(pou);
};
usePlc.subscribe(all);
useSeenAs.subscribe(() => {
  for (const pou of looking.keys()) again(pou);
});
document.addEventListener("visibilitychange", all);
