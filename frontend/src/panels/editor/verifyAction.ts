/** From the text into the verification: the lines that are selected, or all of the POU at the caret. */
import { pouAt } from "../../logic/explorer";
import { t } from "../../logic/text";
import { useDocuments } from "../../store/documents";
import { verifyLines, verifyPou } from "../../store/verify";
import { type editor, KeyCode, KeyMod } from "./monaco";

/** What is selected in each editor, for the button above the text. */
const selections = new Map<string, editor.IStandaloneCodeEditor>();

export function addVerifyAction(code: editor.IStandaloneCodeEditor, path: string): void {
  selections.set(path, code);
  code.onDidDispose(() => selections.get(path) === code && selections.delete(path));
  code.addAction({
    id: "scanbench.verify",
    label: t("verify.range.menu"),
    contextMenuGroupId: "1_debug",
    contextMenuOrder: 3,
    keybindings: [KeyMod.CtrlCmd | KeyMod.Alt | KeyCode.KeyV],
    run: () => verifyHere(path),
  });
}

/** Lines that are selected: one that ends at the beginning of a line does not take that line. */
export function verifyHere(path: string): void {
  const selection = selections.get(path)?.getSelection();
  if (selection && !selection.isEmpty()) {
    const { startLineNumber: first, endLineNumber: last, endColumn } = selection;
    verifyLines(path, first, endColumn === 1 && last > first ? last - 1 : last);
    return;
  }
  const { pous, open } = useDocuments.getState();
  const pou = pouAt(pous, path, selection?.startLineNumber ?? 1, open[path]?.text);
  if (pou) verifyPou(pou.name);
  else verifyLines(path, 1, open[path]?.text.split("\n").length ?? 1);
}
