import type { DocumentSymbol, SymbolKind } from "vscode-languageserver-types";

/** A symbol of a file from one line up to and with another; its name is where it begins. */
export function symbolOf(
  name: string,
  kind: SymbolKind,
  first: number,
  last: number,
  children: DocumentSymbol[] = [],
): DocumentSymbol {
  const start = { line: first - 1, character: 0 };
  const range = { start, end: { line: last - 1, character: 40 } };
  return { name, kind, range, selectionRange: { start, end: start }, children };
}
