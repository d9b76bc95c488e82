import { type KeyboardEvent, useEffect, useId, useRef, useState } from "react";
import { pathBefore, withPath } from "../../logic/expression";
import { complete } from "../../store/completion";
import { useRun } from "../../store/run";
import type { PlcSymbol } from "../../wire/types";

interface Props {
  label: string;
  value: string;
  onChange: (value: string) => void;
  bad?: boolean;
}

const DELAY = 80;
const MOST = 6;

/** A condition, with the paths of the running program completed where the caret stands; empty it offers those asked for before. */
export function ConditionBox({ label, value, onChange, bad = false }: Props) {
  const id = useId();
  const input = useRef<HTMLInputElement>(null);
  const conditions = useRun((run) => run.conditions);
  const [offers, setOffers] = useState<readonly PlcSymbol[]>([]);
  const [chosen, setChosen] = useState(-1);
  const [path, setPath] = useState("");

  useEffect(() => {
    setOffers([]);
    setChosen(-1);
    if (path === "") return;
    let gone = false;
    const timer = setTimeout(() => void complete(path).then((found) => !gone && setOffers(found.slice(0, MOST))), DELAY);
    return () => {
      gone = true;
      clearTimeout(timer);
    };
  }, [path]);

  function take(symbol: PlcSymbol): void {
    const caret = input.current?.selectionStart ?? value.length;
    const next = withPath(value, caret, symbol.path);
    onChange(next.text);
    setPath("");
    requestAnimationFrame(() => input.current?.setSelectionRange(next.caret, next.caret));
  }

  function onKeyDown(event: KeyboardEvent): void {
    const count = offers.length;
    const offer = offers[chosen];
    if (event.key === "ArrowDown" && count > 0) setChosen((chosen + 1) % count);
    else if (event.key === "ArrowUp" && count > 0) setChosen((chosen + count - 1) % count);
    else if (event.key === "Escape" && count > 0) setPath("");
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
        list={value === "" && conditions.length > 0 ? `${id}-before` : undefined}
        value={value}
        spellCheck={false}
        autoComplete="off"
        onChange={(event) => {
          onChange(event.target.value);
          setPath(pathBefore(event.target.value, event.target.selectionStart ?? event.target.value.length));
        }}
        onKeyDown={onKeyDown}
        onBlur={() => setPath("")}
      />
      <datalist id={`${id}-before`}>
        {conditions.map((condition) => (
          <option key={condition} value={condition} />
        ))}
      </datalist>
      {open && (
        <span className="conditionoffers" role="listbox" id={id} aria-label={label}>
          {offers.map((symbol, index) => (
            <span
              key={symbol.path}
              id={`${id}-${index}`}
              role="option"
              aria-selected={index === chosen}
              className={`mi${index === chosen ? " on" : ""}`}
              onPointerDown={(event) => event.preventDefault()}
              onClick={() => take(symbol)}
            >
              <span className="mono cut">{symbol.path}</span>
              <span className="k">{symbol.type}</span>
            </span>
          ))}
        </span>
      )}
    </span>
  );
}
