import { type KeyboardEvent, useEffect, useId, useRef, useState } from "react";
import { t } from "../../logic/text";
import { complete } from "../../store/completion";
import { addAllToTrace } from "../../store/traces";
import { Icon } from "../../ui/Icon";
import type { PlcSymbol } from "../../wire/types";

const DELAY = 80;

/** Typing a variable, an address or an expression to record, with what the program has to offer. */
export function AddSignal() {
  const [text, setText] = useState("");
  const [offers, setOffers] = useState<readonly PlcSymbol[]>([]);
  const [chosen, setChosen] = useState(-1);
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
  }, [text]);

  async function add(path: string): Promise<void> {
    turn.current += 1;
    setOffers([]);
    if (path.trim() !== "" && (await addAllToTrace([path.trim()]))) setText("");
  }

  /** What has members is gone on into; the rest is recorded. */
  function take(symbol: PlcSymbol): void {
    if (symbol.expandable) setText(symbol.kind === "array" ? `${symbol.path}[` : `${symbol.path}.`);
    else void add(symbol.path);
  }

  function onKeyDown(event: KeyboardEvent): void {
    const count = offers.length;
    const offer = offers[chosen];
    if (event.key === "ArrowDown" && count > 0) setChosen((chosen + 1) % count);
    else if (event.key === "ArrowUp" && count > 0) setChosen((chosen + count - 1) % count);
    else if (event.key === "Tab" && offer) setText(offer.path);
    else if (event.key === "Escape" && count > 0) setOffers([]);
    else if (event.key === "Enter" && offer) take(offer);
    else if (event.key === "Enter") void add(text);
    else return;
    event.preventDefault();
  }

  const open = offers.length > 0;
  return (
    <div className="addbox traddbox">
      <span className="inp sm">
        <Icon name="plus" small />
        <input
          role="combobox"
          aria-label={t("trace.add")}
          aria-expanded={open}
          aria-controls={id}
          aria-autocomplete="list"
          aria-activedescendant={chosen >= 0 ? `${id}-${chosen}` : undefined}
          placeholder={t("trace.add.placeholder")}
          value={text}
          spellCheck={false}
          autoComplete="off"
          onChange={(event) => setText(event.target.value)}
          onKeyDown={onKeyDown}
          onBlur={() => setOffers([])}
        />
      </span>
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
              onClick={() => take(symbol)}
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
