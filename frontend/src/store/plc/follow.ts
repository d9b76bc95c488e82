/** The live value of one path, for as long as somebody shows it. */
import { bindCell } from "./values";
import { watch } from "./watches";

/** Tells the value now and whenever it changes, until the returned function is called. */
export function follow(path: string, ...shown: Shown): () => void {
  const release = watch([path]);
  const unbind = bindCell(path, ...shown);
  return () => {
    unbind();
    release();
  };
}

type Shown = Parameters<typeof bindCell> extends [string, ...infer Rest] ? Rest : never;
