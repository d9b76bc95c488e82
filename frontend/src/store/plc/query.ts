/** A query about the selected instance: the content of a dialog while it is open. */
import { create } from "zustand";
import { messageOf } from "../../logic/format/messageOf";
import { useBench } from "./bench";
import { onInstanceChange } from "./reset";

interface Asked<K, T> {
  /** The query itself; null while there is none. */
  asked: K | null;
  found: T | null;
  /** Why there is no result. */
  refused: string | null;
}

interface Options {
  /** The previous result stays until the new answer arrives. */
  keeps?: boolean;
}

/** The answer is dropped after a later query, a change of the instance, or `close`. */
export function query<K, T>(fetch: (instance: number, asked: K) => Promise<T>, { keeps = false }: Options = {}) {
  const nothing: Asked<K, T> = { asked: null, found: null, refused: null };
  const use = create<Asked<K, T>>(() => nothing);
  let turn = 0;

  async function ask(asked: K): Promise<void> {
    turn += 1;
    const mine = turn;
    const instance = useBench.getState().instance?.id;
    use.setState(keeps ? { asked, refused: null } : { ...nothing, asked });
    if (instance === undefined) return;
    try {
      const found = await fetch(instance, asked);
      if (mine === turn) use.setState({ found });
    } catch (error) {
      if (mine === turn) use.setState({ found: null, refused: messageOf(error) });
    }
  }

  /** Shows why there is nothing to query. */
  function refuse(asked: K, refused: string): void {
    turn += 1;
    use.setState({ asked, found: null, refused });
  }

  function close(): void {
    turn += 1;
    use.setState(nothing);
  }

  onInstanceChange(close);
  return { use, ask, refuse, close };
}
