/** Shows who last wrote the variable at the caret. */

import { refuseWriter, showWriter } from "../../../store/past/writer";
import { t } from "../../../text";
import type { editor } from "./monaco";
import { nameAtCaret, pathsOf, selectedNames } from "./watchAction";

export function addWriterAction(code: editor.IStandaloneCodeEditor, path: string): void {
  code.addAction({
    id: "scanbench.writer",
    label: t("writer.menu.name"),
    contextMenuGroupId: "navigation",
    run: async () => {
      const line = code.getPosition()?.lineNumber ?? 1;
      const [name] = await pathsOf(path, line, selectedNames(code) ?? nameAtCaret(code));
      if (name) showWriter(name);
      else refuseWriter(t("writer.noname"));
    },
  });
}
