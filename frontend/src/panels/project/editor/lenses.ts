/** How many instances and references a declaration has, above it, where somebody wants that: by the language server. */

import { ICommandService } from "monaco-editor/platform/commands/common/commands";
import type { CodeLens, Location } from "vscode-languageserver-types";
import { usePrefs } from "../../../store/page/prefs";
import { useDocuments } from "../../../store/project/documents";
import { ask, askAt, askOf } from "../../../store/project/language";
import { editor, type IPosition, languages, type Uri } from "./monaco";
import { at, isPast, locationsOf, pathOfModel, rangeOf, signalOf } from "./serverShapes";
import { LANGUAGE } from "./st";

const counted = new WeakMap<languages.CodeLens, CodeLens>();
const listeners = new Set<(provider: languages.CodeLensProvider) => void>();

const provider: languages.CodeLensProvider = {
  onDidChange: (listener) => {
    listeners.add(listener);
    return { dispose: () => void listeners.delete(listener) };
  },
  provideCodeLenses: async (model, token) => {
    if (isPast(model)) return { lenses: [] };
    const found = await askOf<CodeLens[]>("textDocument/codeLens", pathOfModel(model), {}, signalOf(token));
    return { lenses: (found ?? []).map(lensOf) };
  },
  resolveCodeLens: async (model, lens, token) => {
    const asked = counted.get(lens);
    const told = asked && (await ask<CodeLens>("codeLens/resolve", asked, signalOf(token)));
    if (!told?.command) return lens;
    const { title, command } = told.command;
    const place = { lineNumber: lens.range.startLineNumber, column: lens.range.startColumn };
    return { ...lens, command: { id: command, title, arguments: [model.uri, place] } };
  },
};

function lensOf(asked: CodeLens): languages.CodeLens {
  const lens = { range: rangeOf(asked.range) };
  counted.set(lens, asked);
  return lens;
}

languages.registerCodeLensProvider(LANGUAGE, provider);

// After a check the numbers may be different in all files.
useDocuments.subscribe((now, before) => {
  if (now.pous !== before.pous) for (const listener of [...listeners]) listener(provider);
});

/** Lists in the text what was counted. The names of these commands are said by the language server. */
function lists(command: string, method: string, more: object): void {
  editor.registerCommand(command, async (accessor, uri: Uri, place: IPosition) => {
    const commands = accessor.get(ICommandService);
    const code = editor.getEditors().find((each) => each.getModel()?.uri.toString() === uri.toString());
    const found = await locationsOf(await askAt<Location[]>(method, uri.path.slice(1), at(place), more));
    // The list opens in the editor that has the focus, and a click on a number does not give it.
    code?.focus();
    await commands.executeCommand("editor.action.peekLocations", uri, place, found, "peek");
  });
}

lists("scanbench.showInstances", "scanbench/instances", {});
lists("scanbench.showReferences", "textDocument/references", { context: { includeDeclaration: false } });

/** Follows the preference. Returns a function that stops it. */
export function showLenses(code: editor.IStandaloneCodeEditor): () => void {
  return usePrefs.subscribe((now, before) => {
    if (now.lenses !== before.lenses) code.updateOptions({ codeLens: now.lenses });
  });
}
