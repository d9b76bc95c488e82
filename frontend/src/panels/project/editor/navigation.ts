/** Definition, implementation, references, names of the same kind in the text, the outline of a file and what can be folded: by the language server. */

import type { DocumentHighlight, DocumentSymbol, FoldingRange, Location } from "vscode-languageserver-types";
import { unsectioned } from "../../../logic/project/outline";
import { openFile } from "../../../store/page/navigate";
import { askAt, askOf } from "../../../store/project/language";
import { symbolsOf } from "../../../store/project/outline";
import { editor, languages } from "./monaco";
import { at, isPast, locationsOf, pathOfModel, rangeOf, signalOf } from "./serverShapes";
import { LANGUAGE } from "./st";

type Token = Parameters<typeof signalOf>[0];
type Ask = (
  model: editor.ITextModel,
  position: { lineNumber: number; column: number },
  token: Token,
) => Promise<languages.Location[]>;

/** Asks for places; a text of the past is not the one that the server knows. */
const places =
  (method: string, more: object = {}): Ask =>
  async (model, position, token) =>
    isPast(model)
      ? []
      : locationsOf(
          await askAt<Location[]>(`textDocument/${method}`, pathOfModel(model), at(position), more, signalOf(token)),
        );

languages.registerDefinitionProvider(LANGUAGE, { provideDefinition: places("definition") });
languages.registerTypeDefinitionProvider(LANGUAGE, { provideTypeDefinition: places("typeDefinition") });
languages.registerImplementationProvider(LANGUAGE, { provideImplementation: places("implementation") });

const everywhere = places("references", { context: { includeDeclaration: true } });
languages.registerReferenceProvider(LANGUAGE, {
  provideReferences: (model, position, _context, token) => everywhere(model, position, token),
});

languages.registerDocumentHighlightProvider(LANGUAGE, {
  provideDocumentHighlights: async (model, position, token) => {
    if (isPast(model)) return [];
    const path = pathOfModel(model);
    const found = await askAt<DocumentHighlight[]>(
      "textDocument/documentHighlight",
      path,
      at(position),
      {},
      signalOf(token),
    );
    // Their kinds count from 1: text, read, write.
    return (found ?? []).map(({ range, kind = 1 }) => ({ range: rangeOf(range), kind: kind - 1 }));
  },
});

languages.registerDocumentSymbolProvider(LANGUAGE, {
  displayName: "Scanbench",
  provideDocumentSymbols: async (model) =>
    isPast(model) ? [] : unsectioned((await symbolsOf(pathOfModel(model))) ?? []).map(symbolOf),
});

const symbolOf = (symbol: DocumentSymbol): languages.DocumentSymbol => ({
  name: symbol.name,
  detail: symbol.detail ?? "",
  kind: symbol.kind - 1,
  tags: [],
  range: rangeOf(symbol.range),
  selectionRange: rangeOf(symbol.selectionRange),
  children: (symbol.children ?? []).map(symbolOf),
});

languages.registerFoldingRangeProvider(LANGUAGE, {
  provideFoldingRanges: async (model, _context, token) => {
    if (isPast(model)) return null;
    const found = await askOf<FoldingRange[]>("textDocument/foldingRange", pathOfModel(model), {}, signalOf(token));
    return found?.map(({ startLine, endLine }) => ({ start: startLine + 1, end: endLine + 1 })) ?? null;
  },
});

/** A place in another file opens that file in its own tab. */
editor.registerEditorOpener({
  openCodeEditor: (source, uri, selection) => {
    const path = uri.path.slice(1);
    if (source.getModel()?.uri.toString() === uri.toString()) return false;
    const place =
      selection &&
      ("lineNumber" in selection
        ? selection
        : { lineNumber: selection.startLineNumber, column: selection.startColumn });
    openFile(path, place?.lineNumber ?? 1, place?.column ?? 1);
    return true;
  },
});
