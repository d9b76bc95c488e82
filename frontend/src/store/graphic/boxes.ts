/** The functions and blocks that can be put into a drawing of a file, as the language server knows them; and the variables that its fields offer. */

import type { CompletionList } from "vscode-languageserver-types";
import type { Box } from "../../logic/graphic/edit";
import { askAt } from "../project/language";

interface Position {
  line: number;
  column: number;
}

/** The last answer for each file. */
const known = new Map<string, readonly Box[]>();

export const boxesNow = (path: string): readonly Box[] => known.get(path) ?? [];

export async function loadBoxes(path: string, at: Position): Promise<readonly Box[]> {
  const found = await askAt<Box[]>("scanbench/boxes", path, at);
  if (found && found.length > 0) known.set(path, found);
  return boxesNow(path);
}

interface Variable {
  name: string;
  type: string;
}

const VARIABLE = 6;
const CONSTANT = 21;

/** The variables that are visible at a place. */
export async function variablesAt(path: string, at: Position): Promise<readonly Variable[]> {
  const found = await askAt<CompletionList>("textDocument/completion", path, at);
  return (found?.items ?? [])
    .filter(({ kind }) => kind === VARIABLE || kind === CONSTANT)
    .map(({ label, detail = "" }) => ({ name: label, type: detail }));
}
