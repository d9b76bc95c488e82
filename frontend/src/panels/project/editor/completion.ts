/** Completions by the language server, from the text as it is being typed. */

import type { CompletionItem, CompletionList } from "vscode-languageserver-types";
import { ask, askAt } from "../../../store/project/language";
import { type IRange, languages } from "./monaco";
import { at, isPast, pathOfModel, signalOf, textOf } from "./serverShapes";
import { LANGUAGE } from "./st";

const { CompletionItemKind: Kind, CompletionItemInsertTextRule: Rule } = languages;

/** Kinds of LSP, which count from 1 in an order of their own; those that the server uses. */
const KINDS: Record<number, languages.CompletionItemKind> = {
  2: Kind.Method,
  3: Kind.Function,
  5: Kind.Field,
  6: Kind.Variable,
  7: Kind.Class,
  8: Kind.Interface,
  9: Kind.Module,
  10: Kind.Property,
  14: Kind.Keyword,
  15: Kind.Snippet,
  20: Kind.EnumMember,
  21: Kind.Constant,
  22: Kind.Struct,
};
const SNIPPET = 2;

interface Offered extends languages.CompletionItem {
  source: CompletionItem;
}

languages.registerCompletionItemProvider(LANGUAGE, {
  triggerCharacters: [".", "#"],
  provideCompletionItems: async (model, position, _context, token) => {
    if (isPast(model)) return { suggestions: [] };
    const path = pathOfModel(model);
    const found = await askAt<CompletionList>("textDocument/completion", path, at(position), {}, signalOf(token));
    const { startColumn } = model.getWordUntilPosition(position);
    const { lineNumber, column } = position;
    const range = { startLineNumber: lineNumber, endLineNumber: lineNumber, startColumn, endColumn: column };
    return { suggestions: (found?.items ?? []).map((item) => offered(item, range)) };
  },
  resolveCompletionItem: async (item, token) => {
    const { source } = item as Offered;
    if (source.data === undefined) return item;
    const told = await ask<CompletionItem>("completionItem/resolve", source, signalOf(token));
    const documentation = told?.documentation;
    return {
      ...item,
      documentation: { value: typeof documentation === "string" ? documentation : textOf(documentation) },
    };
  },
});

const offered = (source: CompletionItem, range: IRange): Offered => ({
  source,
  range,
  label: { label: source.label, ...(source.detail === undefined ? {} : { description: source.detail }) },
  kind: KINDS[source.kind ?? 0] ?? Kind.Text,
  insertText: source.insertText ?? source.label,
  ...(source.insertTextFormat === SNIPPET ? { insertTextRules: Rule.InsertAsSnippet } : {}),
  sortText: source.sortText ?? source.label,
});
