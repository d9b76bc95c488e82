/** F1: the help of what has the focus. */
import { nameAt, problemHelp, standardHelp, topicOf } from "../logic/page/help";
import { showHelp } from "../store/page/help";
import { useDocuments } from "../store/project/documents";

/** The name or the problem at the caret, the control, the pane with the focus: the first of them that has help. */
export function helpHere(): void {
  const focused = document.activeElement;
  const own = focused?.closest<HTMLElement>("[data-help]")?.dataset.help;
  const pane = focused?.closest<HTMLElement>("[data-pane]")?.dataset.pane;
  const tab = focused?.closest(".dv-tab")?.querySelector<HTMLElement>("[data-panel]")?.dataset.panel;
  showHelp(
    ...(own === undefined ? [] : [own]),
    ...(pane === "editor" ? atCaret() : []),
    topicOf(pane ?? tab ?? "start"),
  );
}

/** A problem that covers the caret, then the standard function or block there. */
function atCaret(): string[] {
  const { active, cursor, open, problems } = useDocuments.getState();
  const text = active === null ? undefined : open[active]?.text;
  if (text === undefined || cursor === null) return [];
  const name = nameAt(text.split("\n")[cursor.line - 1] ?? "", cursor.column);
  const problem = problems.find(({ file, line }) => file === active && line === cursor.line);
  return [...(problem ? [problemHelp(problem.code)] : []), ...(name === null ? [] : [standardHelp(name)])];
}
