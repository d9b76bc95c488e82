/** What the palette offers for a text: files and what they declare, symbols alone, or commands. */

import { SymbolKind, type WorkspaceSymbol } from "vscode-languageserver-types";
import { isPanelFile } from "../../../logic/project/panelFiles";
import { openFile } from "../../../store/page/navigate";
import { COMMANDS, commandsNow, SYMBOLS, usePalette } from "../../../store/page/palette";
import { useDocuments } from "../../../store/project/documents";
import type { IconName } from "../../../ui/drawings";
import type { Offer } from "../../../ui/useOffers";

export interface Target extends Offer {
  go: () => void;
}

const MOST = 12;
/** By kind of symbol; everything else is a variable. */
const ICONS: Partial<Record<SymbolKind, IconName>> = {
  [SymbolKind.Module]: "program",
  [SymbolKind.Class]: "fb",
  [SymbolKind.Interface]: "fb",
  [SymbolKind.Method]: "fn",
  [SymbolKind.Function]: "fn",
  [SymbolKind.Struct]: "struct",
  [SymbolKind.Enum]: "struct",
  [SymbolKind.Event]: "task",
  [SymbolKind.Namespace]: "plc",
};

/** What has these letters in its name, in this order: what begins with them first. */
export async function targets(typed: string): Promise<Target[]> {
  if (typed.startsWith(COMMANDS)) return commands(typed.slice(COMMANDS.length));
  if (typed.startsWith(SYMBOLS)) return (await places(typed.slice(SYMBOLS.length).trim(), false)).slice(0, MOST);
  return (await places(typed.trim(), true)).slice(0, MOST);
}

function commands(typed: string): Target[] {
  const words = typed.toUpperCase();
  return ranked(
    commandsNow()
      .filter(({ label }) => contains(label.toUpperCase(), words))
      .map(({ label, keys, run }) => ({ path: label, type: keys ?? "", icon: "cmd", go: run })),
    words.trim(),
  );
}

/** Files before what they declare where the rank is the same. */
async function places(typed: string, withFiles: boolean): Promise<Target[]> {
  // The language server is loaded with the first editor, or here.
  const { ask, pathOf } = await import("../../../store/project/language");
  const letters = typed.toUpperCase();
  const all = withFiles ? useDocuments.getState().files : [];
  const files = all.filter(({ path }) => contains(path.toUpperCase(), letters));
  const symbols = await ask<WorkspaceSymbol[]>("workspace/symbol", { query: typed });
  usePalette.setState({ unasked: symbols === null });
  const declared = (symbols ?? []).flatMap(({ name, kind, containerName, location }): Target[] => {
    if (!("range" in location)) return [];
    const { start } = location.range;
    const file = pathOf(location.uri);
    const inside = containerName !== undefined && containerName !== file;
    const path = inside ? `${containerName}.${name}` : name;
    const go = () => openFile(file, start.line + 1, start.character + 1);
    return [{ path, type: file, icon: ICONS[kind] ?? "var", go }];
  });
  const opened = files.map(
    ({ path }): Target => ({ path, type: "", icon: isPanelFile(path) ? "layout" : "list", go: () => openFile(path) }),
  );
  // the halves of a property are declared twice
  const once = new Map([...opened, ...declared].map((target) => [`${target.path} ${target.type}`, target]));
  return ranked([...once.values()], letters);
}

function ranked(found: Target[], letters: string): Target[] {
  return letters === "" ? found : found.sort((a, b) => rank(a.path, letters) - rank(b.path, letters));
}

function rank(path: string, letters: string): number {
  const at = path.toUpperCase().indexOf(letters);
  return at < 0 ? 2 : Math.min(at, 1);
}

function contains(name: string, letters: string): boolean {
  let from = 0;
  for (const letter of letters.replaceAll(" ", "")) {
    const at = name.indexOf(letter, from);
    if (at < 0) return false;
    from = at + 1;
  }
  return true;
}
