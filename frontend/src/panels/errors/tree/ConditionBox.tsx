import { type KeyboardEvent, useEffect, useId, useRef, useState } from "react";
import { pathBefore, withPath } from "../../../logic/plc/expression";
import { useRun } from "../../../store/debug/run";
import { complete } from "../../../store/plc/completion";

interface Props {
  label: string;
  value: string;
  onChange: (value: string) => void;
  bad?: boolean;
}

interface Offer {
  text: string;
  hint: string;
}

const DELAY = 80;
const MOST = 6;

/** A condition, with the paths of the running program completed where the caret stands; empty it offers those asked for before. */
export function ConditionBox({ label, value, onChange, bad = false }: Props) {
  const id = useId();
  const input = useRef<HTMLInputElement>(null);
  const conditions = useRun((run) => run.conditions);
  const [offers, setOffers] = useState<readonly Offer[]>([]);
  const [chosen, setChosen] = useState(-1);
  const [path, setPath] = useState("");

  useEffect(() => {
    setOffers([]);
    setChosen(-1);
    if (path === "") return;
    let gone = false;
    const timer = setTimeout(() => {
      void complete(path).then((symbols) => {
        if (!gone) setOffers(symbols.slice(0, MOST).map((symbol) => ({ text: symbol.path, hint: symbol.type })));
      });
    }, DELAY);
    return () => {
      gone = true;
      clearTimeout(timer);
    };
  }, [path]);

  function take(offer: Offer): void {
    const caret = input.current?.selectionStart ?? value.length;
    const next = withPath(value, caret, offer.text);
    onChange(next.text);
    setPath("");
    setOffers([]);
    requestAnimationFrame(() => input.current?.setSelectionRange(next.caret, next.caret));
  }

  function close(): void {
    setPath("");
    setOffers([]);
  }

  function onKeyDown(event: KeyboardEvent): void {
    const count = offers.length;
    const offer = offers[chosen];
    if (event.key === "ArrowDown" && count > 0) setChosen((chosen + 1) % count);
    else if (event.key === "ArrowUp" && count > 0) setChosen((chosen + count - 1) % count);
    else if (event.key === "Escape" && count > 0) close();
    else if ((event.key === "Enter" || event.key === "Tab") && offer) take(offer);
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  const open = offers.length > 0;
  return (
    <span className="condition">
      <input
        ref={input}
        className={`inp sm mono${bad ? " bad" : ""}`}
        role="combobox"
        aria-label={label}
        aria-expanded={open}
        aria-controls={open ? id : undefined}
        aria-autocomplete="list"
        aria-activedescendant={chosen >= 0 ? `${id}-${chosen}` : undefined}
        aria-invalid={bad}
        placeholder="Main.count > 3"
        value={value}
        spellCheck={false}
        autoComplete="off"
        onChange={(event) => {
          onChange(event.target.value);
          setPath(pathBefore(event.target.value, event.target.selectionStart ?? event.target.value.length));
        }}
        onKeyDown={onKeyDown}
        onFocus={() => {
          if (value === "") setOffers(conditions.map((text) => ({ text, hint: "" })));
        }}
        onBlur={close}
      />
      {open && (
        <span className="conditionoffers" role="listbox" id={id} aria-label={label}>
          {offers.map((offer, index) => (
            <span
              key={offer.text}
              id={`${id}-${index}`}
              role="option"
              aria-selected={index === chosen}
              className={`mi${index === chosen ? " on" : ""}`}
              onPointerDown={(event) => event.preventDefault()}
              onClick={() => take(offer)}
            >
              <span className="mono cut">{offer.text}</span>
              <span className="k">{offer.hint}</span>
            </span>
          ))}
        </span>
      )}
    </span>
  );
}
