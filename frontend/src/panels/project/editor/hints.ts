/** The names of parameters before the arguments of a call that are given by position: by the language server. */

import type { InlayHint } from "vscode-languageserver-types";
import { askOf } from "../../../store/project/language";
import { languages } from "./monaco";
import { isPast, lspRangeOf, pathOfModel, signalOf } from "./serverShapes";
import { LANGUAGE } from "./st";

const NONE: languages.InlayHintList = { hints: [], dispose: () => undefined };

languages.registerInlayHintsProvider(LANGUAGE, {
  displayName: "Scanbench",
  provideInlayHints: async (model, range, token) => {
    if (isPast(model)) return NONE;
    const asked = { range: lspRangeOf(range) };
    const found = await askOf<InlayHint[]>("textDocument/inlayHint", pathOfModel(model), asked, signalOf(token));
    return { ...NONE, hints: (found ?? []).map(hintOf) };
  },
});

const hintOf = ({ label, position }: InlayHint): languages.InlayHint => ({
  label: typeof label === "string" ? label : label.map(({ value }) => value).join(""),
  position: { lineNumber: position.line + 1, column: position.character + 1 },
  kind: languages.InlayHintKind.Parameter,
  paddingRight: true,
});
