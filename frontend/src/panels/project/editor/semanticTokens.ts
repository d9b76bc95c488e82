/** Colours by what a name means, for the lines that are visible: by the language server. The themes are in `monaco.ts`. */

import { askOf } from "../../../store/project/language";
import { languages } from "./monaco";
import { isPast, lspRangeOf, pathOfModel, signalOf } from "./serverShapes";
import { LANGUAGE } from "./st";

/** In the order in which the server counts them (`language/tokens.py`). */
const LEGEND: languages.SemanticTokensLegend = {
  tokenTypes: ["variable", "parameter", "property", "function", "method", "class", "type", "enumMember"],
  tokenModifiers: ["readonly", "declaration", "defaultLibrary"],
};

languages.registerDocumentRangeSemanticTokensProvider(LANGUAGE, {
  getLegend: () => LEGEND,
  provideDocumentRangeSemanticTokens: async (model, range, token) => {
    if (isPast(model)) return null;
    const path = pathOfModel(model);
    const asked = { range: lspRangeOf(range) };
    const found = await askOf<{ data: number[] }>("textDocument/semanticTokens/range", path, asked, signalOf(token));
    return found && { data: new Uint32Array(found.data) };
  },
});
