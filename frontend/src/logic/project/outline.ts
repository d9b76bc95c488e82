/** What a file declares, as the language server tells it, and where in it the caret is. */
import type { DocumentSymbol, SymbolKind } from "vscode-languageserver-types";

interface Place {
  line: number;
  column: number;
}

/** The kind of a statement that has others inside of it. */
const STATEMENT: SymbolKind = 25;

/** What is declared, without the statements. */
export const declared = (symbols: readonly DocumentSymbol[]): DocumentSymbol[] =>
  symbols
    .filter(({ kind }) => kind !== STATEMENT)
    .map((symbol) => ({ ...symbol, children: declared(symbol.children ?? []) }));

const SECTION: SymbolKind = 4;

/** The same without a level for the sections of variables: for lists of names, and for lines that stay in sight while one scrolls. */
export const unsectioned = (symbols: readonly DocumentSymbol[]): DocumentSymbol[] =>
  declared(symbols).flatMap((symbol) => {
    const children = unsectioned(symbol.children ?? []);
    return symbol.kind === SECTION ? children : [{ ...symbol, children }];
  });

export interface Level {
  symbol: DocumentSymbol;
  /** What is beside it, and itself. */
  siblings: readonly DocumentSymbol[];
}

/** What is around a place, the outermost first. */
export function chainAt(symbols: readonly DocumentSymbol[], place: Place): Level[] {
  const symbol = symbols.findLast(({ range }) => holds(range, place));
  if (!symbol) return [];
  return [{ symbol, siblings: symbols }, ...chainAt(symbol.children ?? [], place)];
}

function holds({ start, end }: DocumentSymbol["range"], { line, column }: Place): boolean {
  const [row, character] = [line - 1, column - 1];
  const begun = row > start.line || (row === start.line && character >= start.character);
  const over = row > end.line || (row === end.line && character > end.character);
  return begun && !over;
}

/** Where one goes to it. */
export const placeOf = ({ selectionRange: { start } }: DocumentSymbol): Place => ({
  line: start.line + 1,
  column: start.character + 1,
});

interface OutlineRow {
  /** Names from the outermost one on, each with which one of this name it is: it stays when lines are added above. */
  key: string;
  level: number;
  symbol: DocumentSymbol;
  /** Undefined: nothing is inside. */
  open: boolean | undefined;
}

/** The rows of the tree. While something is looked for, all that has it in its name, and what is around it. */
export function outlineRows(
  symbols: readonly DocumentSymbol[],
  isOpen: (key: string, level: number) => boolean,
  looked: string,
  level = 0,
  around = "",
): OutlineRow[] {
  const wanted = looked.trim().toLowerCase();
  const counts = new Map<string, number>();
  return symbols.flatMap((symbol) => {
    const count = (counts.get(symbol.name) ?? 0) + 1;
    counts.set(symbol.name, count);
    const key = keyOf(around, symbol, count);
    const inside = symbol.children ?? [];
    const open = wanted !== "" || isOpen(key, level);
    const below = open ? outlineRows(inside, isOpen, looked, level + 1, key) : [];
    if (wanted !== "" && below.length === 0 && !symbol.name.toLowerCase().includes(wanted)) return [];
    return [{ key, level, symbol, open: inside.length === 0 ? undefined : open }, ...below];
  });
}

/** The keys of what is around a place, the outermost first. */
export function keysAt(symbols: readonly DocumentSymbol[], place: Place): string[] {
  const keys: string[] = [];
  for (const { symbol, siblings } of chainAt(symbols, place)) {
    const same = siblings.filter(({ name }) => name === symbol.name);
    keys.push(keyOf(keys.at(-1) ?? "", symbol, same.indexOf(symbol) + 1));
  }
  return keys;
}

const keyOf = (around: string, { name }: DocumentSymbol, count: number) => `${around}/${name}#${count}`;
