/** The parameters of the call at the caret. */

import type { SignatureHelp } from "vscode-languageserver-types";
import { askAt } from "../../../store/project/language";
import { languages } from "./monaco";
import { at, isPast, pathOfModel, signalOf } from "./serverShapes";
import { LANGUAGE } from "./st";

languages.registerSignatureHelpProvider(LANGUAGE, {
  signatureHelpTriggerCharacters: ["(", ","],
  signatureHelpRetriggerCharacters: [","],
  provideSignatureHelp: async (model, position, token) => {
    if (isPast(model)) return null;
    const path = pathOfModel(model);
    const found = await askAt<SignatureHelp>("textDocument/signatureHelp", path, at(position), {}, signalOf(token));
    if (!found) return null;
    const signatures = found.signatures.map(({ label, documentation, parameters = [] }) => ({
      label,
      documentation: typeof documentation === "string" ? documentation : "",
      parameters: parameters.map((parameter) => ({ label: parameter.label })),
    }));
    const value = { signatures, activeSignature: 0, activeParameter: found.activeParameter ?? 0 };
    return { value, dispose: () => undefined };
  },
});
