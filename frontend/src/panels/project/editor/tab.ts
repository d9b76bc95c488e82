/** The Tab key: takes the first suggestion, or indents an empty line like its block. Enter and all other keys only insert text. */
import { t } from "../../../text";
import type { editor } from "./monaco";
import { KeyCode } from "./monaco";
import { opens } from "./st";

export function addTabActions(code: editor.IStandaloneCodeEditor): void {
  code.addAction({
    id: "scanbench.firstSuggestion",
    label: t("editor.firstsuggestion"),
    keybindings: [KeyCode.Tab],
    precondition: "suggestWidgetVisible && !suggestWidgetHasFocusedSuggestion && textInputFocus",
    run: () => {
      code.trigger("keyboard", "selectNextSuggestion", null);
      code.trigger("keyboard", "acceptSelectedSuggestion", null);
    },
  });
  code.addAction({
    id: "scanbench.indent",
    label: t("editor.indent"),
    keybindings: [KeyCode.Tab],
    precondition:
      "editorTextFocus && !editorReadonly && !editorHasSelection && !editorTabMovesFocus && !suggestWidgetVisible",
    run: () => {
      const missing = missingIndent(code);
      code.trigger("keyboard", missing === "" ? "tab" : "type", missing === "" ? null : { text: missing });
    },
  });
}

/** The missing indentation of an empty line; nothing for a line with text, or with several carets. */
function missingIndent(code: editor.IStandaloneCodeEditor): string {
  const model = code.getModel();
  const [caret, ...others] = code.getSelections() ?? [];
  if (!model || !caret || others.length > 0) return "";
  const here = model.getLineContent(caret.startLineNumber);
  if (here.trim() !== "" || caret.startColumn <= here.length) return "";
  let above = caret.startLineNumber - 1;
  while (above > 0 && model.getLineContent(above).trim() === "") above -= 1;
  if (above === 0) return "";
  const text = model.getLineContent(above);
  const wanted = (/^\s*/.exec(text)?.[0] ?? "") + (opens.test(text) ? " ".repeat(model.getOptions().indentSize) : "");
  return wanted.startsWith(here) ? wanted.slice(here.length) : "";
}
