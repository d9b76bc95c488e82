/** What is fitted, as a file of the project: its text is edited like every other, so undo, drafts and versions are the same. */
import { HARDWARE, NO_HARDWARE } from "../../logic/errors/hardware";
import { scheduleCheck } from "../project/checking";
import { createFile, edit, isDirty, openDocument, save, useDocuments } from "../project/documents";
import { sharedText } from "../project/drafts";

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

/** As long as the page is open, checks also find the numbers that the program raises errors with. */
export function followNumbers(): () => void {
  useDocuments.setState({ wantsNumbers: true });
  scheduleCheck();
  return () => useDocuments.setState({ wantsNumbers: false, numbers: null });
}
