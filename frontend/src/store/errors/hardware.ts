/** What is fitted, as a file of the project: its text is edited like every other, so undo, drafts and versions are the same. */

import { useShallow } from "zustand/react/shallow";
import { isFitted, type Known } from "../../logic/errors/fitted";
import { HARDWARE, NO_HARDWARE } from "../../logic/errors/hardware";
import type { ErrorInfo, GenerateOne } from "../../wire/types";
import { useBench } from "../plc/bench";
import { usePlc } from "../plc/plc";
import { scheduleCheck } from "../project/checking";
import { createFile, edit, isDirty, openDocument, save, useDocuments } from "../project/documents";
import { sharedText } from "../project/drafts";
import { catalogueNow } from "./catalogue";

/** Makes the file, with nothing in it. Throws the server's refusal. */
export async function beginHardware(): Promise<void> {
  await createFile(HARDWARE, NO_HARDWARE);
  await openDocument(HARDWARE);
}

/** Changes the text as it is now: somebody may have typed in it a moment ago. */
export function changeHardware(change: (text: string) => string): void {
  const text = useDocuments.getState().open[HARDWARE]?.text;
  if (text !== undefined) edit(HARDWARE, change(text));
}

export const saveHardware = () => save(HARDWARE);
export const undoHardware = () => sharedText(HARDWARE)?.undo() ?? false;
export const redoHardware = () => sharedText(HARDWARE)?.redo() ?? false;
export const useHardwareEdited = () => useDocuments(({ open }) => isDirty(open[HARDWARE]));

/** Whether the project has what an error is of: with what hardware.json said when the PLC's program was built. */
export function isFittedNow(one: GenerateOne): boolean {
  const { instances, errors } = usePlc.getState();
  const error = catalogueNow().byId.get(one.id);
  return error === undefined || isFitted(error, one, { known: hasHardware(), instances, kinds: errors });
}

export const useFitted = (error: ErrorInfo, one: GenerateOne): boolean => isFitted(error, one, useKnownHardware());

/** What is known of what is fitted, of the program that runs. */
export function useKnownHardware(): Known {
  const known = useBench((bench) => bench.model?.hardware === true);
  const { instances, errors: kinds } = usePlc(useShallow(({ instances, errors }) => ({ instances, errors })));
  return { known, instances, kinds };
}

const hasHardware = () => useBench.getState().model?.hardware === true;

/** As long as the page is open, checks also find the numbers that the program raises errors with. */
export function followNumbers(): () => void {
  useDocuments.setState({ wantsNumbers: true });
  scheduleCheck();
  return () => useDocuments.setState({ wantsNumbers: false, numbers: null });
}
