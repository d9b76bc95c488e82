/** Something asked of the server about the instance that is looked at: what a dialog shows while it is open. */
import { create } from "zustand";
import { messageOf } from "../../logic/format/messageOf";
import { useBench } from "./bench";
import { onInstanceChange } from "./reset";

interface Asked<K, T> {
  /** As it was asked for; null while nothing is. */
  asked: K | null;
  found: T | null;
  /** Why nothing was found. */
  refused: string | null;
}

interface Options {
  /** What was found before stays in sight until the new answer is here. */
  keeps?: boolean;
}

/** A question of its own: a later one, another instance or `close` drop the answer of the one before. */
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

  /** There is nothing to ask: says why. */
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
