/** Formats a file or some of its lines: only when somebody asks for it. */

import type { Range, TextEdit } from "vscode-languageserver-types";
import { askOf } from "../../../store/project/language";
import { editor, type IRange, KeyCode, KeyMod, languages } from "./monaco";
import { isPast, pathOfModel, rangeOf, signalOf } from "./serverShapes";
import { LANGUAGE } from "./st";

type Token = Parameters<typeof signalOf>[0];

async function formatted(method: string, model: editor.ITextModel, more: object, token: Token) {
  if (isPast(model)) return [];
  const { tabSize, insertSpaces } = model.getOptions();
  const asked = { options: { tabSize, insertSpaces }, ...more };
  const edits = await askOf<TextEdit[]>(method, pathOfModel(model), asked, signalOf(token));
  return (edits ?? []).map(({ range, newText }) => ({ range: rangeOf(range), text: newText }));
}

const lines = ({ startLineNumber, endLineNumber }: IRange): Range => ({
  start: { line: startLineNumber - 1, character: 0 },
  end: { line: endLineNumber - 1, character: 0 },
});

languages.registerDocumentFormattingEditProvider(LANGUAGE, {
  provideDocumentFormattingEdits: (model, _options, token) => formatted("textDocument/formatting", model, {}, token),
});

languages.registerDocumentRangeFormattingEditProvider(LANGUAGE, {
  provideDocumentRangeFormattingEdits: (model, range, _options, token) =>
    formatted("textDocument/rangeFormatting", model, { range: lines(range) }, token),
});

// Monaco's own key differs from system to system, and on Linux it is a key of the browser.
editor.addKeybindingRule({
  keybinding: KeyMod.Shift | KeyMod.Alt | KeyCode.KeyF,
  command: "editor.action.formatDocument",
  when: "editorTextFocus && !editorReadonly",
});
