/** Steps of the debugger: what the buttons and keys send, and whom the view follows. */
import { create } from "zustand";
import { permits } from "../../logic/debug/stepping";
import { isPaced } from "../../logic/verify/verify";
import { openFile } from "../page/navigate";
import { usePlc } from "../plc/plc";
import { useVerify } from "../verify/verify";
import { ask } from "./debug";
import { caretPlace } from "./debugKeys";

type StepCommand = "continue" | "pause" | "next" | "stepIn" | "stepOut" | "stepBack" | "reverseContinue";

/** Whether a way back is searched for so long that people wonder: from then on it is said, and the buttons are off. */
export const useStepping = create<{ searching: boolean }>(() => ({ searching: false }));

const isStepwise = () => useVerify.getState().verifications.some((info) => info.pace === "step" && isPaced(info));

/** Most searches are over before one could read of them. */
const NOTICED_MS = 250;
let goingBack = false;

/** While the PLC searches back it answers nothing else: what is pressed meanwhile is dropped, not kept for later. */
async function back(command: string, args: object): Promise<void> {
  if (goingBack) return;
  goingBack = true;
  const said = setTimeout(() => useStepping.setState({ searching: true }), NOTICED_MS);
  try {
    await ask(command, args);
  } finally {
    clearTimeout(said);
    goingBack = false;
    useStepping.setState({ searching: false });
  }
}

/** Steps from a PLC that runs halt it first; what cannot be done now is not sent. */
export async function step(command: StepCommand): Promise<void> {
  const { state, link } = usePlc.getState();
  if (goingBack || link.state !== "open" || !permits(state, command)) return;
  if (command === "stepBack" || command === "reverseContinue") await back(command, { threadId: 1 });
  else await ask(command, { threadId: 1 });
}

/** Up to the first statement of the next scan. */
export async function stepScan(): Promise<void> {
  if (!goingBack) await ask("scanbench/singleScan");
}

export async function runTo(file: string, line: number): Promise<void> {
  if (!goingBack) await ask("scanbench/runTo", { source: { path: file }, line });
}

/** Ctrl+F10. */
export function runToCaret(): void {
  const place = caretPlace();
  if (place) void runTo(place.file, place.line);
}

/** Back to the last write of a variable. */
export async function reverseTo(path: string): Promise<void> {
  await back("scanbench/reverseTo", { path });
}

// A halt opens its file for the one who caused it. Others are told, and go there when they want to: nobody's text is taken away.
usePlc.subscribe(({ state: now, you, users }, { state: before }) => {
  const halt = now?.halt;
  if (!halt || halt.file === "" || halt.number === before?.halt?.number) return;
  const alone = new Set(users.map(({ name }) => name)).size < 2;
  // Step by step the Verification panel shows the statement: the editor does not come in front of it.
  if ((alone || halt.by === you?.name) && !isStepwise()) openFile(halt.file);
});
