import { type ClipboardEvent, type KeyboardEvent, useEffect, useState } from "react";
import { ComboBox } from "./ComboBox";
import { Icon } from "./Icon";
import { type Offer, useOffers } from "./useOffers";

/** The text of the field, and why it is refused. */
interface Taken {
  text: string;
  odd?: string;
}

interface Props<T extends Offer> {
  label: string;
  placeholder: string;
  className?: string;
  /** The paths of the program that begin with the text. */
  complete: (text: string) => Promise<readonly T[]>;
  onType: (text: string) => Taken | Promise<Taken>;
  onTake: (symbol: T) => Taken | Promise<Taken>;
  /** Handles pasted text; false: it is inserted as usual. */
  onPaste?: (text: string) => boolean;
}

/** A field for a path, with completion: Tab completes, Enter takes the path. */
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
    offering.close(); // suggestions that are still being fetched are dropped
    const now = await taken;
    setText((typed) => (typed === text ? now.text : typed)); // the user may have continued typing
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
