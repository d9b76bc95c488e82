/** What the editor can do, among all commands while its file is in front. */

import { offerCommands } from "../../../store/page/palette";
import { useDocuments } from "../../../store/project/documents";
import { t } from "../../../text";
import type { editor } from "./monaco";

export function offerEditorCommands(code: editor.IStandaloneCodeEditor, path: string): () => void {
  return offerCommands(() => {
    if (useDocuments.getState().active !== path) return [];
    return code
      .getSupportedActions()
      .filter(({ label }) => label !== "")
      .map((action) => ({
        label: t("command.editor", { what: action.label }),
        run: () => {
          code.focus();
          void action.run();
        },
      }));
  });
}
