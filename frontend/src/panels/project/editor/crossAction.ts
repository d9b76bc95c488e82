/** Shows who reads and who writes the variable at the caret. */

import { showCrossReferences, showCrossReferencesOf } from "../../../store/project/cross";
import { t } from "../../../text";
import { type editor, KeyCode, KeyMod } from "./monaco";
import { isPast } from "./serverShapes";
import { nameAtCaret, pathsOf } from "./watchAction";

export function addCrossAction(code: editor.IStandaloneCodeEditor, path: string): void {
  code.addAction({
    id: "scanbench.cross",
    label: t("cross.title"),
    keybindings: [KeyMod.CtrlCmd | KeyMod.Alt | KeyCode.KeyR],
    contextMenuGroupId: "navigation",
    run: async () => {
      const { lineNumber: line, column } = code.getPosition() ?? { lineNumber: 1, column: 1 };
      const model = code.getModel();
      const word = model?.getWordAtPosition({ lineNumber: line, column })?.word.toUpperCase();
      const [found] = await pathsOf(path, line, nameAtCaret(code));
      // Of `belt.speed` the caret may be in `belt`: that is what is asked about.
      const variable =
        found
          ?.toUpperCase()
          .replace(/\[.*?\]$/, "")
          .split(".")
          .at(-1) === word
          ? found
          : undefined;
      // A text of the past is not the one that is searched: only the variable leads from there to it.
      if (model && isPast(model)) return variable ? showCrossReferencesOf(variable) : undefined;
      await showCrossReferences({ file: path, line, column }, variable ?? null);
    },
  });
}
