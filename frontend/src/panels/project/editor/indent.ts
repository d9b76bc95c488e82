/**
 * Indents the line to which Enter leads, and moves what ends a block to the level of its beginning. Whoever begins the line with a blank
 * indents it himself: then only what was typed is in the text.
 */

import { blanksOf, indentAfter, indentOfOpener } from "../../../logic/project/indent";
import { finishedBy } from "../../../logic/project/onType";
import type { editor } from "./monaco";

/** For a text that may be edited. Returns a function that stops it. */
export function indentTyped(code: editor.IStandaloneCodeEditor): () => void {
  /** The line of the caret, as long as its indentation is ours; `fresh` while nothing was typed in it. */
  let ours: { line: number; first: string; now: string; fresh: boolean } | null = null;
  let applying = false;

  function set(model: editor.ITextModel, line: number, blanks: string): void {
    const before = blanksOf(model.getLineContent(line)).length;
    const range = { startLineNumber: line, startColumn: 1, endLineNumber: line, endColumn: before + 1 };
    applying = true;
    // The caret stays where it is in the words: an edit before it moves it.
    code.executeEdits("scanbench.indent", [{ range, text: blanks, forceMoveMarkers: true }]);
    applying = false;
  }

  function entered(model: editor.ITextModel, line: number): void {
    const before = ours;
    ours = null;
    const caret = code.getPosition();
    // Where others type in the same text, their caret is not this one.
    if (caret?.lineNumber !== line || caret.column !== 1) return;
    if (before?.line === line - 1 && model.getLineContent(line - 1) === before.now) set(model, line - 1, "");
    const wanted = indentAfter((at) => model.getLineContent(at), line, " ".repeat(model.getOptions().indentSize));
    if (wanted === "" || /^\s/.test(model.getLineContent(line))) return;
    set(model, line, wanted);
    ours = { line, first: wanted, now: wanted, fresh: true };
  }

  function typedIn(model: editor.ITextModel): void {
    if (ours === null) return;
    const { line, first, now, fresh } = ours;
    const content = model.getLineContent(line);
    const blanks = blanksOf(content);
    if (blanks !== now) {
      ours = null;
      // Of what is inserted at once, each character is a change; all of them are there already.
      if (fresh && blanks.startsWith(now)) set(model, line, blanks.slice(now.length));
      return;
    }
    const wanted = indentOfOpener((at) => model.getLineContent(at), line) ?? first;
    if (wanted !== now) set(model, line, wanted);
    ours = { line, first, now: wanted, fresh: false };
  }

  const typing = code.onDidChangeModelContent(({ changes, isFlush, isUndoing, isRedoing }) => {
    const model = code.getModel();
    if (!model || applying) return;
    const [change, ...others] = changes;
    if (!change || others.length > 0 || isFlush || isUndoing || isRedoing || !code.hasTextFocus()) {
      ours = null;
      return;
    }
    const finished = finishedBy(changes, (line) => model.getLineContent(line));
    const { range } = change;
    if (finished?.ch !== "\n" && ours?.line !== range.startLineNumber) ours = null;
    // The caret moves after the text.
    queueMicrotask(() => {
      if (model.isDisposed()) return;
      if (finished?.ch === "\n") entered(model, finished.line);
      else typedIn(model);
    });
  });
  return () => typing.dispose();
}
