/** The range of *Verify range*: the selected lines, or the whole POU at the caret. In a file of its own, because the page needs it before Monaco is loaded. */
import { pouAt } from "../../../logic/plc/sourceLines";
import { shownText } from "../../../store/project/shownProgram";
import { verifyLines, verifyPou } from "../../../store/verify/verify";
import type { editor } from "./monaco";

/** The selection of each editor, for the button above the text. */
const selections = new Map<string, editor.IStandaloneCodeEditor>();

/** Tracks the selection of this editor from now on. */
export function rememberSelection(code: editor.IStandaloneCodeEditor, path: string): void {
  selections.set(path, code);
  code.onDidDispose(() => selections.get(path) === code && selections.delete(path));
}

/** The selected lines: a selection that ends at the beginning of a line does not include that line. */
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
