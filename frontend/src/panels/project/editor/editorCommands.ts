/** What the editor can do, among all commands while its file is in front. */

import { offerCommands } from "../../../store/page/palette";
import { useDocuments } from "../../../store/project/documents";
import { t } from "../../../text";
import type { editor } from "./monaco";

/** The editor's own list of commands, which is not used: all of them are in the palette. */
const OWN_LIST = "editor.action.quickCommand";

export function offerEditorCommands(code: editor.IStandaloneCodeEditor, path: string): () => void {
  return offerCommands(() => {
    if (useDocuments.getState().active !== path) return [];
    return code
      .getSupportedActions()
      .filter(({ id, label }) => label !== "" && id !== OWN_LIST)
      .map((action) => ({
        label: t("command.editor", { what: action.label }),
        run: () => {
          code.focus();
          void action.run();
        },
      }));
  });
}
