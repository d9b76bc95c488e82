/** Loads the editor when it is first shown. Monaco reads its own words once, when its code begins: Japanese ones have to be there before. */
import { language } from "../../../text";

export async function afterWords<T>(load: () => Promise<T>): Promise<T> {
  if (language() === "ja") await import("monaco-editor/nls/lang/ja");
  return load();
}
