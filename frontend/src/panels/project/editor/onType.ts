/**
 * Formats what was just typed, where somebody wants that. Monaco has a way of its own, which drops an answer when the next key came before
 * it: a quick typist would hardly ever get one. Here what is typed below a finished line does not matter.
 */

import type { TextEdit } from "vscode-languageserver-types";
import { type Finished, FinishedLines, finishedBy } from "../../../logic/project/onType";
import { usePrefs } from "../../../store/page/prefs";
import { askAt } from "../../../store/project/language";
import type { editor } from "./monaco";
import { rangeOf } from "./serverShapes";

/** For a text that may be edited. Returns a function that stops it. */
export function formatTyped(code: editor.IStandaloneCodeEditor, path: string): () => void {
  const lines = new FinishedLines();
  let asking = false;
  let applying = false;
  let over = false;
  /** Counts the changes that are not our own. */
  let typed = 0;

  const ask = async ({ ch, line, column }: Finished) => {
    const { tabSize, insertSpaces } = code.getModel()?.getOptions() ?? { tabSize: 2, insertSpaces: true };
    const more = { ch, options: { tabSize, insertSpaces } };
    const found = await askAt<TextEdit[]>("textDocument/onTypeFormatting", path, { line, column }, more);
    return over ? [] : (found ?? []).map(({ range, newText }) => ({ range: rangeOf(range), text: newText }));
  };

  function apply(edits: Awaited<ReturnType<typeof ask>>): void {
    if (edits.length === 0) return;
    applying = true;
    code.pushUndoStop();
    code.executeEdits("scanbench.onType", edits);
    code.pushUndoStop();
    applying = false;
  }

  /** Enter: one line after the other. */
  async function pump(): Promise<void> {
    if (asking) return;
    asking = true;
    for (let line = lines.next(); line !== undefined && !over; line = lines.next()) {
      const edits = await ask({ ch: "\n", line: line + 1, column: 1 });
      if (lines.fits(edits)) apply(edits);
      else lines.again(line);
    }
    asking = false;
  }

  /** The line in which the caret is: only if nobody typed on. Where only our own edits came before the answer, it is asked for again. */
  async function here(finished: Finished): Promise<void> {
    const mine = typed;
    while (typed === mine && !over) {
      const version = code.getModel()?.getVersionId();
      const edits = await ask(finished);
      if (typed === mine && code.getModel()?.getVersionId() === version) {
        apply(edits);
        return;
      }
    }
  }

  const typing = code.onDidChangeModelContent(({ changes, isFlush, isUndoing, isRedoing }) => {
    const model = code.getModel();
    if (!model) return;
    if (applying) {
      lines.own(changes);
      return;
    }
    typed += 1;
    const wanted = usePrefs.getState().formatOnType && code.hasTextFocus() && !(isFlush || isUndoing || isRedoing);
    const finished = wanted ? finishedBy(changes, (line) => model.getLineContent(line)) : null;
    const enter = finished?.ch === "\n";
    lines.note(changes, enter ? finished.line - 1 : null);
    if (!finished) return;
    // Where others type in the same text, their caret is not this one, which moves after the text.
    queueMicrotask(() => {
      const caret = code.getPosition();
      if (over || caret?.lineNumber !== finished.line || caret.column !== finished.column) return;
      void (enter ? pump() : here(finished));
    });
  });

  return () => {
    over = true;
    typing.dispose();
  };
}
