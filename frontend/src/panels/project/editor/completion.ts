/** Completions: variables of the POU in the running program, globals, POUs, keywords; after a point the members. */

import { loadNames, pathOf, seenAsNow } from "../../../store/debug/seenAs";
import { offeredMembers } from "../../../store/plc/completion";
import { useMembers } from "../../../store/plc/members";
import { useDocuments } from "../../../store/project/documents";
import type { PlcSymbol, Pou } from "../../../wire/types";
import { type IPosition, type IRange, languages } from "./monaco";
import { pouOf } from "./names";
import { keywords, LANGUAGE, types } from "./st";

const { CompletionItemKind: Kind } = languages;

const POU_KINDS: Record<Pou["kind"], languages.CompletionItemKind> = {
  program: Kind.Module,
  function_block: Kind.Class,
  class: Kind.Class,
  interface: Kind.Interface,
  function: Kind.Function,
  method: Kind.Method,
  property: Kind.Property,
  type: Kind.Struct,
  global: Kind.Variable,
};

languages.registerCompletionItemProvider(LANGUAGE, {
  triggerCharacters: ["."],
  provideCompletionItems: async (model, position) => {
    const before = model.getLineContent(position.lineNumber).slice(0, position.column - 1);
    const word = model.getWordUntilPosition(position);
    const range = rangeOf(position, word.startColumn);
    const pou = pouOf(model, position.lineNumber)?.name;
    const owner = /([\p{L}_][\p{L}\d_]*(?:\[[^\]]*\]|\.[\p{L}\d_]+|\^)*)\.[\p{L}\d_]*$/u.exec(before)?.[1];
    if (pou !== undefined) await loadNames(pou);
    if (owner !== undefined) return { suggestions: await members(pou, owner, range) };
    return { suggestions: [...variables(pou, range), ...declared(range), ...words(range)] };
  },
});

const rangeOf = ({ lineNumber, column }: IPosition, from: number): IRange => ({
  startLineNumber: lineNumber,
  endLineNumber: lineNumber,
  startColumn: from,
  endColumn: column,
});

async function members(pou: string | undefined, owner: string, range: IRange): Promise<languages.CompletionItem[]> {
  // All elements of an array have the same members; most arrays have the first element.
  const instance = pou === undefined ? undefined : seenAsNow(pou);
  const path = (pou !== undefined && pathOf(pou, `${owner}.`)?.replace(/\.$/, "")) || owner;
  const fixed = path.replace(/\[[^\]]*[\p{L}_][^\]]*\]/gu, "[1]");
  const found = await offeredMembers(fixed);
  const inside = found.length > 0 || instance === undefined ? found : await offeredMembers(`${instance}.${owner}`);
  return inside.map((symbol) => item(symbol, "0", range));
}

function variables(pou: string | undefined, range: IRange): languages.CompletionItem[] {
  const { of } = useMembers.getState();
  const instance = pou === undefined ? undefined : seenAsNow(pou);
  const own = instance === undefined ? [] : (of.get(instance) ?? []);
  const globals = (of.get("") ?? []).filter(({ section }) => section !== "PROGRAM");
  return [...own.map((symbol) => item(symbol, "0", range)), ...globals.map((symbol) => item(symbol, "1", range))];
}

const item = (symbol: PlcSymbol, order: string, range: IRange): languages.CompletionItem => ({
  label: { label: symbol.name, description: symbol.type },
  kind: symbol.expandable ? Kind.Struct : Kind.Variable,
  detail: symbol.address ?? undefined,
  insertText: symbol.name,
  sortText: order + symbol.name,
  range,
});

function declared(range: IRange): languages.CompletionItem[] {
  const { pous } = useDocuments.getState();
  return pous
    .filter(({ kind }) => kind !== "method" && kind !== "property" && kind !== "program")
    .map(({ name, kind, file }) => ({
      label: { label: name, description: file },
      kind: POU_KINDS[kind],
      insertText: name,
      sortText: `2${name}`,
      range,
    }));
}

const words = (range: IRange): languages.CompletionItem[] =>
  [...keywords, ...types].map((word) => ({
    label: word,
    kind: Kind.Keyword,
    insertText: word,
    sortText: `3${word}`,
    range,
  }));
