/** Steps of the debugger: what the buttons and keys send, and whom the view follows. */
import { permits } from "../logic/stepping";
import { ask } from "./debug";
import { caretPlace } from "./debugKeys";
import { openFile } from "./navigate";
import { usePlc } from "./plc";

export type StepCommand = "continue" | "pause" | "next" | "stepIn" | "stepOut" | "stepBack" | "reverseContinue";

/** Steps from a PLC that runs halt it first; what cannot be done now is not sent. */
export async function step(command: StepCommand): Promise<void> {
  const { state, link } = usePlc.getState();
  if (link.state !== "open" || !permits(state, command)) return;
  await ask(command, { threadId: 1 });
}

/** Up to the first statement of the next scan. */
export async function stepScan(): Promise<void> {
  await ask("scanbench/singleScan");
}

export async function runTo(file: string, line: number): Promise<void> {
  await ask("scanbench/runTo", { source: { path: file }, line });
}

/** Ctrl+F10. */
export function runToCaret(): void {
  const place = caretPlace();
  if (place) void runTo(place.file, place.line);
}

/** Back to the last write of a variable. */
export async function reverseTo(path: string): Promise<void> {
  await ask("scanbench/reverseTo", { path });
}

// A halt opens its file for the one who caused it. Others are told, and go there when they want to: nobody's text is taken away.
usePlc.subscribe(({ state: now, you, users }, { state: before }) => {
  const halt = now?.halt;
  if (!halt || halt.file === "" || halt.number === before?.halt?.number) return;
  const alone = new Set(users.map(({ name }) => name)).size < 2;
  if (alone || halt.by === you?.name) openFile(halt.file);
});
