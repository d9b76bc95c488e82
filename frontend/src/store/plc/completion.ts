/** Paths that begin with the typed text. A failed request offers nothing; entering the path will show the reason. */
import { rest } from "../../wire/rest";
import type { PlcSymbol } from "../../wire/types";
import { useBench } from "./bench";
import { isAway, loadMembers, useMembers } from "./members";

export async function complete(text: string): Promise<readonly PlcSymbol[]> {
  const instance = useBench.getState().instance;
  if (!instance) return [];
  try {
    return await rest.complete(instance.id, text);
  } catch {
    return [];
  }
}

/** The members of the typed text before a point; none when it is not a variable of the running program. */
export async function offeredMembers(path: string): Promise<readonly PlcSymbol[]> {
  const { instance, of } = useMembers.getState();
  const known = of.get(path);
  if (known || instance === null || isAway()) return known ?? [];
  try {
    return await rest.offeredSymbols(instance, path);
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
