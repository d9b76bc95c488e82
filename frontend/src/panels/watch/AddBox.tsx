import { type ClipboardEvent, type KeyboardEvent, useEffect, useId, useRef, useState } from "react";
import { pathsIn } from "../../logic/paths";
import { t } from "../../logic/text";
import { useBench } from "../../store/bench";
import { complete } from "../../store/completion";
import { addToWatch } from "../../store/watchlist";
import { Icon } from "../../ui/Icon";
import type { PlcSymbol } from "../../wire/types";

const DELAY = 80;

/** Typing a path, an address or a range of them, with what the running program has to offer. Enter adds it. */
export function AddBox() {
  const [text, setText] = useState("");
  const [offers, setOffers] = useState<readonly PlcSymbol[]>([]);
  const [chosen, setChosen] = useState(-1);
  const turn = useRef(0);
  const id = useId();
  // A model without areas is watched by variables only.
  const example = useBench(({ model }) => {
    const first = model?.areas[0]?.first;
    return [first, model?.code_word, first && `${first}:8`].filter(Boolean).join(", ");
  });

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

  function add(paths: readonly string[]): void {
    if (paths.length === 0) return;
    addToWatch(paths);
    turn.current += 1;
    setText("");
    setOffers([]);
  }

  function onKeyDown(event: KeyboardEvent): void {
    const count = offers.length;
    if (event.key === "ArrowDown" && count > 0) setChosen((chosen + 1) % count);
    else if (event.key === "ArrowUp" && count > 0) setChosen((chosen + count - 1) % count);
    else if (event.key === "Tab" && chosen >= 0) setText(offers[chosen]?.path ?? text);
    else if (event.key === "Escape") setOffers([]);
    else if (event.key === "Enter") add(pathsIn(chosen >= 0 ? (offers[chosen]?.path ?? text) : text));
    else return;
    event.preventDefault();
  }

  // One line is edited as usual; many lines are many entries.
  function onPaste(event: ClipboardEvent): void {
    const pasted = event.clipboardData.getData("text/plain");
    if (!/\S[\r\n]+\s*\S/.test(pasted)) return;
    event.preventDefault();
    event.stopPropagation();
    add(pathsIn(pasted));
  }

  const open = offers.length > 0;
  return (
    <div className="addbox">
      <span className="inp sm">
        <Icon name="plus" small />
        <input
          role="combobox"
          aria-label={t("watch.add")}
          aria-expanded={open}
          aria-controls={id}
          aria-autocomplete="list"
          aria-activedescendant={chosen >= 0 ? `${id}-${chosen}` : undefined}
          placeholder={example ? t("watch.add.placeholder.address", { example }) : t("watch.add.placeholder")}
          value={text}
          spellCheck={false}
          autoComplete="off"
          onChange={(event) => setText(event.target.value)}
          onKeyDown={onKeyDown}
          onPaste={onPaste}
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
              onClick={() => add([symbol.path])}
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
