import { type KeyboardEvent, useEffect, useId, useState } from "react";
import type { IconName } from "./drawings";

/** A path, and the text beside it. */
export interface Offer {
  path: string;
  type: string;
  /** That of a variable if it has none of its own. */
  icon?: IconName;
  /** What it is, below its name. */
  about?: string;
}

const DELAY = 80;

/** Suggestions for the typed text: requested a moment after the last key, chosen by arrows. `complete` must stay the same function.
 * `first`: the first one is chosen already. */
export function useOffers<T extends Offer>(
  complete: (text: string) => Promise<readonly T[]>,
  most?: number,
  first = false,
) {
  const id = useId();
  const [query, ask] = useState("");
  const [offers, setOffers] = useState<readonly T[]>([]);
  const [chosen, setChosen] = useState(-1);
  const [nothing, setNothing] = useState(false);
  const [of, setOf] = useState("");

  useEffect(() => {
    setChosen(-1);
    setNothing(false);
    const text = query.trim();
    if (text === "") return setOffers([]);
    let gone = false;
    const timer = setTimeout(() => {
      const show = (found: readonly T[]) => {
        if (gone) return;
        setOffers(found.slice(0, most));
        setOf(text);
        setNothing(found.length === 0);
        setChosen(first && found.length > 0 ? 0 : -1);
      };
      complete(text).then(show, () => show([]));
    }, DELAY);
    return () => {
      gone = true;
      clearTimeout(timer);
    };
  }, [query, complete, most, first]);

  function close(): void {
    ask("");
    setOffers([]);
    setChosen(-1);
  }

  /** False when the key has no meaning here. */
  function onKey({ key }: KeyboardEvent, take: (offer: T, by: "Enter" | "Tab") => void): boolean {
    const count = offers.length;
    const offer = offers[chosen];
    if (key === "ArrowDown" && count > 0) setChosen((chosen + 1) % count);
    else if (key === "ArrowUp" && count > 0) setChosen((chosen + count - 1) % count);
    else if (key === "Escape" && count > 0) close();
    else if ((key === "Enter" || key === "Tab") && offer) take(offer, key);
    else return false;
    return true;
  }

  return { id, offers, of, chosen, choose: setChosen, nothing, ask, show: setOffers, close, onKey };
}

export type Offering<T extends Offer> = ReturnType<typeof useOffers<T>>;
