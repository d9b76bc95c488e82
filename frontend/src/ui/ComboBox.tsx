import {
  type ClipboardEvent,
  type KeyboardEvent,
  type ReactNode,
  type RefObject,
  useCallback,
  useEffect,
  useLayoutEffect,
  useRef,
  useState,
} from "react";
import { createPortal } from "react-dom";
import { t } from "../text";
import { Icon } from "./Icon";
import { layer } from "./Menu";
import type { Offer, Offering } from "./useOffers";

interface Props<T extends Offer> {
  label: string;
  value: string;
  offering: Offering<T>;
  onType: (text: string, caret: number) => void;
  onTake: (offer: T, by: "Enter" | "Tab" | "click") => void;
  /** Keys with a meaning beyond choosing; true when a key was handled. */
  onKey?: (event: KeyboardEvent) => boolean;
  onPaste?: (event: ClipboardEvent) => void;
  onFocus?: () => void;
  onBlur?: () => void;
  input?: RefObject<HTMLInputElement | null>;
  className?: string;
  placeholder?: string;
  bad?: boolean;
  disabled?: boolean;
  id?: string;
  /** Id of the text that says what is wrong. */
  about?: string;
  /** Class of the list, which is then placed by the style sheet; without a class it floats above the page. */
  list?: string;
  /** A mouse that moves chooses as the arrows do. */
  pointed?: boolean;
  /** The accessible name of the list. */
  listed?: string;
}

/** A text field with a list of suggestions: arrows choose, Enter and Tab take, Escape closes. The focus stays in the field. */
export function ComboBox<T extends Offer>(props: Props<T>) {
  const { label, value, offering, bad = false, list, listed = t("watch.offers"), onTake } = props;
  const own = useRef<HTMLInputElement>(null);
  const input = props.input ?? own;
  const { id, offers, chosen } = offering;
  const open = offers.length > 0;

  function onKeyDown(event: KeyboardEvent): void {
    if (!offering.onKey(event, onTake) && !props.onKey?.(event)) return;
    event.preventDefault();
    event.stopPropagation();
  }

  const options = offers.map((offer, index) => (
    <div
      key={`${offer.path} ${offer.type}`}
      id={`${id}-${index}`}
      role="option"
      aria-selected={index === chosen}
      ref={index === chosen ? intoView : null}
      className={`mi${index === chosen ? " on" : ""}`}
      onPointerDown={(event) => event.preventDefault()}
      onPointerMove={({ movementX, movementY }) => {
        // the list may come under a mouse that rests
        if (props.pointed && index !== chosen && (movementX !== 0 || movementY !== 0)) offering.choose(index);
      }}
      onClick={() => onTake(offer, "click")}
    >
      {(offer.type || offer.icon) && <Icon name={offer.icon ?? "var"} small />}
      <span className="mono cut">{offer.path}</span>
      <span className="k">{offer.type}</span>
      {offer.about && <span className="about cut">{offer.about}</span>}
    </div>
  ));
  const box = { id, role: "listbox", "aria-label": listed };
  return (
    <>
      <input
        ref={input}
        id={props.id}
        className={props.className}
        role="combobox"
        aria-label={label}
        aria-expanded={open}
        aria-controls={open ? id : undefined}
        aria-autocomplete="list"
        aria-activedescendant={chosen >= 0 ? `${id}-${chosen}` : undefined}
        aria-invalid={bad}
        aria-describedby={props.about}
        placeholder={props.placeholder}
        value={value}
        disabled={props.disabled}
        spellCheck={false}
        autoComplete="off"
        onChange={({ target }) => props.onType(target.value, target.selectionStart ?? target.value.length)}
        onKeyDown={onKeyDown}
        onPaste={props.onPaste}
        onFocus={props.onFocus}
        onBlur={() => {
          offering.close();
          props.onBlur?.();
        }}
      />
      {open && list !== undefined && (
        <div {...box} className={list}>
          {options}
        </div>
      )}
      {open && list === undefined && input.current && (
        <Floating {...box} below={input.current} onGone={offering.close}>
          {options}
        </Floating>
      )}
    </>
  );
}

const intoView = (option: HTMLElement | null) => option?.scrollIntoView?.({ block: "nearest" });

interface FloatingProps {
  id: string;
  role: string;
  "aria-label": string;
  below: HTMLElement;
  children: ReactNode;
  onGone: () => void;
}

/** Outside the element that scrolls, so that it is not cut off; it goes with its field, and is closed when that is out of sight. */
function Floating({ below, onGone, ...box }: FloatingProps) {
  const menu = useRef<HTMLDivElement>(null);
  const [place, setPlace] = useState<{ left: number; top: number; maxHeight?: number }>({ left: 0, top: 0 });
  const put = useCallback(() => {
    const { left, top, bottom } = below.getBoundingClientRect();
    const { width = 0 } = menu.current?.getBoundingClientRect() ?? {};
    const height = menu.current?.scrollHeight ?? 0;
    // Below the field, unless there is more room above it; a list that is longer than that is scrolled.
    const [under, over] = [innerHeight - bottom - 6, top - 6];
    const fits = height <= under || under >= over;
    const most = fits ? under : over;
    setPlace({
      left: Math.max(4, Math.min(left, innerWidth - width - 4)),
      top: fits ? bottom + 2 : top - Math.min(height, most) - 2,
      maxHeight: Math.max(0, most),
    });
    return bottom > 0 && top < innerHeight;
  }, [below]);
  useLayoutEffect(() => {
    put();
  }, [put]);
  useEffect(() => {
    // The list itself scrolls, too.
    const onScroll = ({ target }: Event) => {
      if (target !== menu.current && !put()) onGone();
    };
    addEventListener("scroll", onScroll, true);
    addEventListener("resize", onGone);
    return () => {
      removeEventListener("scroll", onScroll, true);
      removeEventListener("resize", onGone);
    };
  });
  return createPortal(<div ref={menu} className="menu" style={place} {...box} />, layer());
}
