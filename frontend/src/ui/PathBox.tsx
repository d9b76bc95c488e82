import { type ClipboardEvent, type KeyboardEvent, useEffect, useId, useRef, useState } from "react";
import { t } from "../text";
import { Icon } from "./Icon";

/** What is in the line now; and why what was typed is not taken. */
interface Taken {
  text: string;
  odd?: string;
}

/** A path, and what stands beside it. */
interface Offer {
  path: string;
  type: string;
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

const DELAY = 80;

/** Typing a path, with what the running program has to offer: arrows choose, Tab takes into the line, Enter takes. */
export function PathBox<T extends Offer>(props: Props<T>) {
  const { label, placeholder, className = "", complete, onType, onTake, onPaste } = props;
  const [text, setText] = useState("");
  const [offers, setOffers] = useState<readonly T[]>([]);
  const [chosen, setChosen] = useState(-1);
  const [odd, setOdd] = useState("");
  const turn = useRef(0);
  const id = useId();

  useEffect(() => {
    turn.current += 1;
    const mine = turn.current;
    if (text.trim() === "") {
      setOffers([]);
      return;
    }
    const timer = setTimeout(() => {
      void complete(text.trim()).then((symbols) => {
        if (turn.current !== mine) return;
        setOffers(symbols);
        setChosen(-1);
      });
    }, DELAY);
    return () => clearTimeout(timer);
  }, [text, complete]);

  async function settle(taken: Taken | Promise<Taken>): Promise<void> {
    turn.current += 1; // offers that are on their way come too late
    setOffers([]);
    const now = await taken;
    setText((typed) => (typed === text ? now.text : typed)); // somebody may have gone on typing
    setOdd(now.odd ?? "");
  }

  function close(): void {
    setOffers([]);
    setOdd("");
  }

  function onKeyDown(event: KeyboardEvent): void {
    const count = offers.length;
    const offer = offers[chosen];
    if (event.key === "ArrowDown" && count > 0) setChosen((chosen + 1) % count);
    else if (event.key === "ArrowUp" && count > 0) setChosen((chosen + count - 1) % count);
    else if (event.key === "Tab" && offer) setText(offer.path);
    else if (event.key === "Escape" && (count > 0 || odd)) close();
    else if (event.key === "Enter") void settle(offer ? onTake(offer) : onType(text));
    else return;
    event.preventDefault();
  }

  function onPasted(event: ClipboardEvent): void {
    if (!onPaste?.(event.clipboardData.getData("text/plain"))) return;
    event.preventDefault();
    event.stopPropagation();
    void settle({ text: "" });
  }

  const open = offers.length > 0;
  return (
    <div className={`addbox ${className}`}>
      <span className="inp sm">
        <Icon name="plus" small />
        <input
          role="combobox"
          aria-label={label}
          aria-expanded={open}
          aria-controls={id}
          aria-autocomplete="list"
          aria-activedescendant={chosen >= 0 ? `${id}-${chosen}` : undefined}
          placeholder={placeholder}
          value={text}
          spellCheck={false}
          autoComplete="off"
          aria-invalid={odd !== ""}
          onChange={(event) => {
            setText(event.target.value);
            setOdd("");
          }}
          onKeyDown={onKeyDown}
          onPaste={onPasted}
          onBlur={close}
        />
      </span>
      {odd && (
        <div className="menu offers nopath" role="alert">
          {odd}
        </div>
      )}
      {open && (
        <div className="menu offers" role="listbox" id={id} aria-label={t("watch.offers")}>
          {offers.map((symbol, index) => (
            <div
              key={symbol.path}
              id={`${id}-${index}`}
              role="option"
              aria-selected={index === chosen}
              className={`mi${index === chosen ? " on" : ""}`}
              onPointerDown={(event) => event.preventDefault()}
              onClick={() => void settle(onTake(symbol))}
            >
              <Icon name="var" small />
              <span className="mono cut">{symbol.path}</span>
              <span className="k">{symbol.type}</span>
            </div>
          ))}
        </div>
      )}
    </div>
  );
}
