/** Shows the call tree of what is named at the caret. */

import { showCalls } from "../../../store/project/calls";
import { t } from "../../../text";
import { type editor, KeyCode, KeyMod } from "./monaco";
import { isPast } from "./serverShapes";

export function addCallsAction(code: editor.IStandaloneCodeEditor, path: string): void {
  code.addAction({
    id: "scanbench.calls",
    label: t("calls.title"),
    keybindings: [KeyMod.Shift | KeyMod.Alt | KeyCode.KeyH],
    contextMenuGroupId: "navigation",
    run: async () => {
      const model = code.getModel();
      // A text of the past is not the one that is searched.
      if (!model || isPast(model)) return;
      const { lineNumber: line, column } = code.getPosition() ?? { lineNumber: 1, column: 1 };
      await showCalls({ file: path, line, column });
    },
  });
}
