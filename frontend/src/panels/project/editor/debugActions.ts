/** Entries of the editor's context menu for debugging. */

import { runTo } from "../../../store/debug/stepping";
import { t } from "../../../text";
import type { Gutter } from "./gutter";
import type { editor } from "./monaco";

type OpenMenu = (line: number, at: { x: number; y: number }) => void;

export function addDebugActions(
  code: editor.IStandaloneCodeEditor,
  path: string,
  gutter: () => Gutter,
  openMenu: OpenMenu,
): void {
  const here = () => code.getPosition()?.lineNumber ?? 1;
  code.addAction({
    id: "scanbench.runto",
    label: t("debug.runhere"),
    contextMenuGroupId: "1_debug",
    contextMenuOrder: 1,
    run: () => void runTo(path, gutter().built(here())),
  });
  code.addAction({
    id: "scanbench.breakpoint",
    label: t("debug.bp.here"),
    contextMenuGroupId: "1_debug",
    contextMenuOrder: 2,
    run: () => {
      const line = here();
      const place = code.getScrolledVisiblePosition({ lineNumber: line, column: 1 });
      const box = code.getDomNode()?.getBoundingClientRect();
      if (place && box) openMenu(line, { x: box.left + place.left, y: box.top + place.top + place.height });
    },
  });
}
