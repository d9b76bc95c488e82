/** The icons of what a file declares, by the kinds of LSP that the server uses. */
import type { DocumentSymbol, SymbolKind } from "vscode-languageserver-types";
import type { IconName } from "../../ui/Icon";

const ICONS: Partial<Record<SymbolKind, IconName>> = {
  2: "program",
  3: "plc",
  4: "list",
  5: "fb",
  6: "fn",
  7: "bound",
  8: "var",
  10: "struct",
  11: "struct",
  12: "fn",
  13: "var",
  14: "var",
  19: "program",
  22: "minus",
  23: "struct",
  24: "task",
  25: "branch",
};

export const symbolIcon = ({ kind }: DocumentSymbol): IconName => ICONS[kind] ?? "var";
