/** What *Verify range* takes: the lines that are selected, or all of the POU at the caret. The page has it before it has Monaco. */
import { pouAt } from "../../../logic/plc/sourceLines";
import { shownText } from "../../../store/project/shownProgram";
import { verifyLines, verifyPou } from "../../../store/verify/verify";
import type { editor } from "./monaco";

/** What is selected in each editor, for the button above the text. */
const selections = new Map<string, editor.IStandaloneCodeEditor>();

/** From now on this editor's selection counts. */
export function rememberSelection(code: editor.IStandaloneCodeEditor, path: string): void {
  selections.set(path, code);
  code.onDidDispose(() => selections.get(path) === code && selections.delete(path));
}

/** Lines that are selected: one that ends at the beginning of a line does not take that line. */
export function verifyHere(path: string): void {
  const selection = selections.get(path)?.getSelection();
  if (selection && !selection.isEmpty()) {
    const { startLineNumber: first, endLineNumber: last, endColumn } = selection;
    verifyLines(path, first, endColumn === 1 && last > first ? last - 1 : last);
    return;
  }
  const { pous, text } = shownText(path);
  const pou = pouAt(pous, path, selection?.startLineNumber ?? 1, text);
  if (pou) verifyPou(pou.name);
  else verifyLines(path, 1, text.split("\n").length);
}
