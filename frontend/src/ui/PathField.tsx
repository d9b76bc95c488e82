import { type KeyboardEvent, useEffect, useId, useLayoutEffect, useRef, useState } from "react";
import { createPortal } from "react-dom";
import { t } from "../text";
import { Icon } from "./Icon";
import { layer } from "./Menu";

interface Offer {
  path: string;
  type: string;
}

interface Props {
  label: string;
  value: string;
  onChange: (value: string) => void;
  /** What the program has that begins like this. */
  complete: (text: string) => Promise<readonly Offer[]>;
  placeholder?: string;
  bad?: boolean;
  disabled?: boolean;
  id?: string;
  /** Id of the text that says why it is bad. */
  about?: string;
}

const DELAY = 80;
const MOST = 8;

/** A path that is filled in, with what the running program has to offer below it: arrows choose, Enter and Tab take. */
export function PathField({ label, value, onChange, complete, placeholder, bad = false, disabled, id, about }: Props) {
  const list = useId();
  const field = useRef<HTMLInputElement>(null);
  const [typed, setTyped] = useState("");
  const [offers, setOffers] = useState<readonly Offer[]>([]);
  const [chosen, setChosen] = useState(-1);

  useEffect(() => {
    setOffers([]);
    setChosen(-1);
    const text = typed.trim();
    if (text === "") return;
    let gone = false;
    const timer = setTimeout(() => {
      void complete(text).then((symbols) => {
        if (!gone) setOffers(symbols.slice(0, MOST));
      });
    }, DELAY);
    return () => {
      gone = true;
      clearTimeout(timer);
    };
  }, [typed, complete]);

  function close(): void {
    setTyped("");
    setOffers([]);
  }

  function take(path: string): void {
    onChange(path);
    close();
  }

  function onKeyDown(event: KeyboardEvent): void {
    const count = offers.length;
    const offer = offers[chosen];
    if (event.key === "ArrowDown" && count > 0) setChosen((chosen + 1) % count);
    else if (event.key === "ArrowUp" && count > 0) setChosen((chosen + count - 1) % count);
    else if (event.key === "Escape" && count > 0) close();
    else if ((event.key === "Enter" || event.key === "Tab") && offer) take(offer.path);
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  const open = offers.length > 0;
  return (
    <>
      <input
        ref={field}
        id={id}
        className={`inp sm mono grow${bad ? " bad" : ""}`}
        role="combobox"
        aria-label={label}
        aria-expanded={open}
        aria-controls={open ? list : undefined}
        aria-autocomplete="list"
        aria-activedescendant={chosen >= 0 ? `${list}-${chosen}` : undefined}
        aria-invalid={bad}
        aria-describedby={about}
        placeholder={placeholder}
        value={value}
        disabled={disabled}
        spellCheck={false}
        autoComplete="off"
        onChange={(event) => {
          onChange(event.target.value);
          setTyped(event.target.value);
        }}
        onKeyDown={onKeyDown}
        onBlur={close}
      />
      {open && field.current && (
        <Offers id={list} below={field.current} offers={offers} chosen={chosen} onTake={take} onGone={close} />
      )}
    </>
  );
}

interface OffersProps {
  id: string;
  below: HTMLElement;
  offers: readonly Offer[];
  chosen: number;
  onTake: (path: string) => void;
  onGone: () => void;
}

/** Outside of whatever the field scrolls in, so that it is not cut off; gone when that scrolls. */
function Offers({ id, below, offers, chosen, onTake, onGone }: OffersProps) {
  const menu = useRef<HTMLDivElement>(null);
  const [place, setPlace] = useState({ left: 0, top: 0 });
  useLayoutEffect(() => {
    const { left, top, bottom } = below.getBoundingClientRect();
    const { width = 0, height = 0 } = menu.current?.getBoundingClientRect() ?? {};
    const fits = bottom + 2 + height <= innerHeight;
    setPlace({ left: Math.max(4, Math.min(left, innerWidth - width - 4)), top: fits ? bottom + 2 : top - height - 2 });
  }, [below]);
  useEffect(() => {
    addEventListener("scroll", onGone, true);
    addEventListener("resize", onGone);
    return () => {
      removeEventListener("scroll", onGone, true);
      removeEventListener("resize", onGone);
    };
  });
  return createPortal(
    <div ref={menu} className="menu" role="listbox" id={id} aria-label={t("watch.offers")} style={place}>
      {offers.map(({ path, type }, index) => (
        <div
          key={path}
          id={`${id}-${index}`}
          role="option"
          aria-selected={index === chosen}
          className={`mi${index === chosen ? " on" : ""}`}
          onPointerDown={(event) => event.preventDefault()}
          onClick={() => onTake(path)}
        >
          <Icon name="var" small />
          <span className="mono cut">{path}</span>
          <span className="k">{type}</span>
        </div>
      ))}
    </div>,
    layer(),
  );
}
