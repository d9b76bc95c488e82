/** The names of parameters before the arguments of a call that are given by position: by the language server. */

import type { InlayHint } from "vscode-languageserver-types";
import { askOf } from "../../../store/project/language";
import { asked } from "./inlayChanges";
import { languages } from "./monaco";
import { isPast, lspRangeOf, pathOfModel, signalOf } from "./serverShapes";
import { LANGUAGE } from "./st";

const NONE: languages.InlayHintList = { hints: [], dispose: () => undefined };

languages.registerInlayHintsProvider(LANGUAGE, {
  displayName: "Scanbench",
  provideInlayHints: async (model, range, token) => {
    if (isPast(model)) return NONE;
    const where = { range: lspRangeOf(range) };
    const answer = askOf<InlayHint[]>("textDocument/inlayHint", pathOfModel(model), where, signalOf(token));
    const found = await asked(answer);
    return { ...NONE, hints: (found ?? []).map(hintOf) };
  },
});

const hintOf = ({ label, position }: InlayHint): languages.InlayHint => ({
  label: typeof label === "string" ? label : label.map(({ value }) => value).join(""),
  position: { lineNumber: position.line + 1, column: position.character + 1 },
  kind: languages.InlayHintKind.Parameter,
  paddingRight: true,
});
