import { type KeyboardEvent, useEffect, useId, useState } from "react";

/** A path, and the text beside it. */
export interface Offer {
  path: string;
  type: string;
}

const DELAY = 80;

/** Suggestions for the typed text: requested a moment after the last key, chosen by arrows. */
export function useOffers<T extends Offer>(complete: (text: string) => Promise<readonly T[]>, most?: number) {
  const id = useId();
  const [query, ask] = useState("");
  const [offers, setOffers] = useState<readonly T[]>([]);
  const [chosen, setChosen] = useState(-1);

  useEffect(() => {
    setChosen(-1);
    const text = query.trim();
    if (text === "") return setOffers([]);
    let gone = false;
    const timer = setTimeout(() => {
      void complete(text).then((found) => {
        if (gone) return;
        setOffers(found.slice(0, most));
        setChosen(-1);
      });
    }, DELAY);
    return () => {
      gone = true;
      clearTimeout(timer);
    };
  }, [query, complete, most]);

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

  return { id, offers, chosen, ask, show: setOffers, close, onKey };
}

export type Offering<T extends Offer> = ReturnType<typeof useOffers<T>>;
