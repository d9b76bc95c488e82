/** Quick fixes of problems, where the language server knows what to do. */

import type { CodeAction } from "vscode-languageserver-types";
import { askOf } from "../../../store/project/language";
import { languages } from "./monaco";
import { isPast, pathOfModel, rangeOf, signalOf } from "./serverShapes";
import { LANGUAGE } from "./st";

languages.registerCodeActionProvider(LANGUAGE, {
  provideCodeActions: async (model, { startLineNumber, startColumn, endLineNumber, endColumn }, { markers }, token) => {
    const nothing = { actions: [], dispose: () => undefined };
    if (isPast(model)) return nothing;
    const range = {
      start: { line: startLineNumber - 1, character: startColumn - 1 },
      end: { line: endLineNumber - 1, character: endColumn - 1 },
    };
    const asked = { range, context: { diagnostics: [] } };
    const found = await askOf<CodeAction[]>("textDocument/codeAction", pathOfModel(model), asked, signalOf(token));
    const actions = (found ?? []).map(({ title, edit, isPreferred = false }) => ({
      title,
      kind: "quickfix",
      diagnostics: markers,
      isPreferred,
      edit: {
        edits: Object.values(edit?.changes ?? {}).flatMap((edits) =>
          edits.map((each) => ({
            resource: model.uri,
            versionId: model.getVersionId(),
            textEdit: { range: rangeOf(each.range), text: each.newText },
          })),
        ),
      },
    }));
    return { ...nothing, actions };
  },
});
