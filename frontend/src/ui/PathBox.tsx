import { type ClipboardEvent, type KeyboardEvent, useEffect, useState } from "react";
import { ComboBox } from "./ComboBox";
import { Icon } from "./Icon";
import { type Offer, useOffers } from "./useOffers";

/** What is in the line now; and why what was typed is not taken. */
interface Taken {
  text: string;
  odd?: string;
}

interface Props<T extends Offer> {
  label: string;
  placeholder: string;
  className?: string;
  /** What the program has that begins like this. */
  complete: (text: string) => Promise<readonly T[]>;
  onType: (text: string) => Taken | Promise<Taken>;
  onTake: (symbol: T) => Taken | Promise<Taken>;
  /** Takes what is pasted; false: it goes into the line as usual. */
  onPaste?: (text: string) => boolean;
}

/** Typing a path, with what the running program has to offer: Tab takes into the line, Enter takes. */
export function PathBox<T extends Offer>(props: Props<T>) {
  const { className = "", complete, onType, onTake, onPaste, ...field } = props;
  const offering = useOffers(complete);
  const [text, setText] = useState("");
  const [odd, setOdd] = useState("");

  const { ask } = offering;
  useEffect(() => ask(text), [ask, text]);

  function type(next: string): void {
    setText(next);
    setOdd("");
  }

  async function settle(taken: Taken | Promise<Taken>): Promise<void> {
    offering.close(); // offers that are on their way come too late
    const now = await taken;
    setText((typed) => (typed === text ? now.text : typed)); // somebody may have gone on typing
    setOdd(now.odd ?? "");
  }

  function onKey({ key }: KeyboardEvent): boolean {
    if (key === "Escape" && odd) setOdd("");
    else if (key === "Enter") void settle(onType(text));
    else return false;
    return true;
  }

  function onPasted(event: ClipboardEvent): void {
    if (!onPaste?.(event.clipboardData.getData("text/plain"))) return;
    event.preventDefault();
    event.stopPropagation();
    void settle({ text: "" });
  }

  return (
    <div className={`addbox ${className}`}>
      <span className="inp sm">
        <Icon name="plus" small />
        <ComboBox
          {...field}
          value={text}
          offering={offering}
          bad={odd !== ""}
          onType={type}
          onTake={(offer, by) => (by === "Tab" ? type(offer.path) : void settle(onTake(offer)))}
          onKey={onKey}
          onPaste={onPasted}
          onBlur={() => setOdd("")}
          list="menu offers"
        />
      </span>
      {odd && (
        <div className="menu offers nopath" role="alert">
          {odd}
        </div>
      )}
    </div>
  );
}
