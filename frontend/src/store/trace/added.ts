/** Signals added from other panels: what somebody looks at stays in front, and the status bar says where the signal is. */
import { create } from "zustand";
import { showPanel } from "../page/navigate";
import { onInstanceChange } from "../plc/reset";
import { addAllToTrace } from "./traces";

/** The path that was added last; null when it was said for long enough. */
export const useAdded = create<{ path: string | null }>(() => ({ path: null }));

const SAID_MS = 20_000;
let over: ReturnType<typeof setTimeout> | undefined;

function say(path: string | null): void {
  clearTimeout(over);
  useAdded.setState({ path });
  if (path !== null) over = setTimeout(() => say(null), SAID_MS);
}

onInstanceChange(() => say(null));

/** A refusal is shown in the trace panel, with similar names. */
export async function addToTrace(path: string): Promise<void> {
  if (await addAllToTrace([path])) say(path);
  else showPanel("trace");
}

export function showAdded(): void {
  say(null);
  showPanel("trace");
}
