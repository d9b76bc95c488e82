/** Paths that begin with the typed text. A failed request offers nothing; entering the path will show the reason. */
import { rest } from "../../wire/rest";
import type { PlcSymbol } from "../../wire/types";
import { useBench } from "./bench";
import { loadMembers, useMembers } from "./members";

export async function complete(text: string): Promise<readonly PlcSymbol[]> {
  const instance = useBench.getState().instance;
  if (!instance) return [];
  try {
    return await rest.complete(instance.id, text);
  } catch {
    return [];
  }
}

/** Every variable of the programs and the globals, for an empty field; or why they are not available. */
export async function topVariables(): Promise<{ paths: string[]; refused: string | undefined }> {
  const top = await loadMembers("");
  const paths: string[] = [];
  for (const symbol of top) {
    const isProgram = symbol.kind === "block" && symbol.expandable;
    if (isProgram) paths.push(...(await loadMembers(symbol.path)).map((member) => member.path));
    else paths.push(symbol.path);
  }
  return { paths, refused: useMembers.getState().refused.get("") };
}
