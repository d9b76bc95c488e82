/** Opens the form of a disturbance for the result of the statement at the caret. */

import { askDisturb } from "../../../store/verify/disturb";
import { t } from "../../../text";
import type { Gutter } from "./gutter";
import type { editor } from "./monaco";

export function addDisturbAction(code: editor.IStandaloneCodeEditor, path: string, gutter: () => Gutter): void {
  code.addAction({
    id: "scanbench.disturb",
    label: t("disturb.action"),
    contextMenuGroupId: "1_debug",
    contextMenuOrder: 9,
    // The PLC knows the lines of the built text, which may have been edited since.
    run: () => askDisturb({ kind: "result", site: `${path}:${gutter().built(code.getPosition()?.lineNumber ?? 1)}` }),
  });
}
