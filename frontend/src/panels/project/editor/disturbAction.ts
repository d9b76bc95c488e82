/** From a line of the text to the disturbance of what its statement writes. */

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
    // The PLC knows the lines as they were built, whatever was typed since.
    run: () => askDisturb({ kind: "result", site: `${path}:${gutter().built(code.getPosition()?.lineNumber ?? 1)}` }),
  });
}
