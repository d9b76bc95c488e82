/** Steps of the debugger: the requests of buttons and keys, and whose view follows a halt. */
import { create } from "zustand";
import { permits } from "../../logic/debug/stepping";
import { lineIn } from "../../logic/plc/sourceLines";
import { isPaced } from "../../logic/verify/verify";
import type { HaltInfo } from "../../wire/types";
import { openFile } from "../page/navigate";
import { usePlc } from "../plc/plc";
import { useDocuments } from "../project/documents";
import { shownText } from "../project/shownProgram";
import { useVerify } from "../verify/verify";
import { ask } from "./debug";
import { caretPlace } from "./debugKeys";

type StepCommand = "continue" | "pause" | "next" | "stepIn" | "stepOut" | "stepBack" | "reverseContinue";

/** True while a search backwards takes noticeably long: the page says so, and the buttons are disabled. */
export const useStepping = create<{ searching: boolean }>(() => ({ searching: false }));

const isStepwise = () => useVerify.getState().verifications.some((info) => info.pace === "step" && isPaced(info));

/** Most searches are over before a message about them could be read. */
const NOTICED_MS = 250;
let goingBack = false;

/** While the PLC searches backwards it answers nothing else: further clicks are dropped, not queued. */
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

/** A step from a running PLC halts it first; impossible steps are not sent. */
export async function step(command: StepCommand): Promise<void> {
  const { state, link } = usePlc.getState();
  if (goingBack || link.state !== "open" || !permits(state, command)) return;
  if (command === "stepBack" || command === "reverseContinue") await back(command, { threadId: 1 });
  else await ask(command, { threadId: 1 });
}

/** Runs to the first statement of the next scan. */
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

/** Goes back to the last write of a variable. */
export async function reverseTo(path: string): Promise<void> {
  await back("scanbench/reverseTo", { path });
}

// A halt opens its file for the person who caused it. For others only a message appears, so that their open text stays.
usePlc.subscribe(({ state: now, you, users }, { state: before }) => {
  const halt = now?.halt;
  if (!halt || halt.file === "" || halt.number === before?.halt?.number) return;
  const alone = new Set(users.flatMap(({ name, client }) => (client ? [] : [name]))).size < 2;
  // In a stepwise verification the Verification panel shows the statement, so the editor does not cover it.
  if ((alone || halt.by === you?.name) && !isStepwise()) openFile(halt.file, lineToGoOn(halt));
});

/** Who types in the text of one file goes on in the file that comes in its place; the caret stays where the file is the same. */
function lineToGoOn({ file, line }: HaltInfo): number | undefined {
  const typing = document.activeElement?.closest("[data-pane='editor']");
  if (!typing || useDocuments.getState().active === file) return undefined;
  const { built, text } = shownText(file);
  return lineIn(built, text, line);
}
