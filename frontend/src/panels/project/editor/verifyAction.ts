/** Verifies code from the editor, by key and context menu. */
import { t } from "../../../text";
import { type editor, KeyCode, KeyMod } from "./monaco";
import { rememberSelection, verifyHere } from "./verifyHere";

export function addVerifyAction(code: editor.IStandaloneCodeEditor, path: string): void {
  rememberSelection(code, path);
  code.addAction({
    id: "scanbench.verify",
    label: t("verify.range.menu"),
    contextMenuGroupId: "1_debug",
    contextMenuOrder: 3,
    keybindings: [KeyMod.CtrlCmd | KeyMod.Alt | KeyCode.KeyV],
    run: () => verifyHere(path),
  });
}
