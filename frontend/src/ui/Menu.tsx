import { type KeyboardEvent, type ReactNode, useCallback, useEffect, useLayoutEffect, useRef, useState } from "react";
import { createPortal } from "react-dom";
import { t } from "../text";
import { Icon, type IconName } from "./Icon";

export interface MenuItem {
  label: string;
  /** The end of the label, which is not cut where there is no room for all of it. */
  end?: string;
  /** Where several items have the same label. */
  key?: string;
  icon?: IconName;
  /** A key or a short note, faint at the right. */
  hint?: string;
  checked?: boolean;
  disabled?: boolean;
  /** A separator above this item. */
  separated?: boolean;
  onSelect: () => void;
}

interface MenuProps {
  label: string;
  items: readonly MenuItem[];
  at: { x: number; y: number; minWidth?: number };
  onClose: () => void;
}

/** A floating menu at a point of the window. Arrow keys, Home, End, first letters; Escape and a click outside close it. */
export function Menu({ label, items, at, onClose }: MenuProps) {
  const menu = useRef<HTMLDivElement>(null);
  const [place, setPlace] = useState({ left: at.x, top: at.y });
  const returnTo = useRef<Element | null>(null);

  useLayoutEffect(() => {
    const element = menu.current;
    if (!element) return;
    returnTo.current = document.activeElement;
    const { width, height } = element.getBoundingClientRect();
    setPlace({
      left: Math.max(4, Math.min(at.x, innerWidth - width - 4)),
      top: Math.max(4, Math.min(at.y, innerHeight - height - 4)),
    });
    (chosen(element) ?? enabled(element)[0])?.focus();
    return () => {
      if (element.contains(document.activeElement) || document.activeElement === document.body) {
        (returnTo.current as HTMLElement | null)?.focus?.();
      }
    };
  }, [at]);

  useEffect(() => {
    const outside = (event: PointerEvent) => {
      if (!menu.current?.contains(event.target as Node)) onClose();
    };
    addEventListener("pointerdown", outside, true);
    addEventListener("blur", onClose);
    return () => {
      removeEventListener("pointerdown", outside, true);
      removeEventListener("blur", onClose);
    };
  }, [onClose]);

  function onKeyDown(event: KeyboardEvent): void {
    // React lets events of a portal bubble to the owner, whose own keys must not react.
    event.stopPropagation();
    const all = menu.current ? enabled(menu.current) : [];
    const now = all.indexOf(document.activeElement as HTMLElement);
    const to = { ArrowDown: now + 1, ArrowUp: now - 1, Home: 0, End: all.length - 1 }[event.key];
    if (to !== undefined) all[(to + all.length) % all.length]?.focus();
    else if (event.key === "Escape" || event.key === "Tab") onClose();
    else if (event.key.length === 1) {
      all.find((item) => item.textContent?.trim().toLowerCase().startsWith(event.key.toLowerCase()))?.focus();
      return;
    } else return;
    event.preventDefault();
  }

  return createPortal(
    <div
      ref={menu}
      className="menu"
      role="menu"
      tabIndex={-1}
      aria-label={label}
      style={{ left: place.left, top: place.top, minWidth: at.minWidth }}
      onKeyDown={onKeyDown}
      onClick={(event) => event.stopPropagation()}
      onBlur={(event) => {
        if (event.relatedTarget && !event.currentTarget.contains(event.relatedTarget)) onClose();
      }}
    >
      {items.map((item) => (
        <MenuEntry key={item.key ?? item.label} item={item} onClose={onClose} />
      ))}
    </div>,
    layer(),
  );
}

/** The menu of a row or a place: the handlers that open it, and the menu while it is open. */
export function useMenu(label = t("menu.label")) {
  const [menu, setMenu] = useState<Pick<MenuProps, "items" | "at"> | null>(null);
  const open = useCallback((items: MenuProps["items"], at: MenuProps["at"]) => setMenu({ items, at }), []);
  return {
    open,
    menu: menu && <Menu label={label} {...menu} onClose={() => setMenu(null)} />,
  };
}

/** Elements outside a modal dialog cannot be clicked, so a menu of the dialog is put inside it. */
export const layer = () => [...document.querySelectorAll("dialog:modal")].at(-1) ?? document.body;

function MenuEntry({ item, onClose }: { item: MenuItem; onClose: () => void }) {
  const icon: IconName | null = item.checked ? "check" : (item.icon ?? null);
  return (
    <>
      {item.separated && <hr />}
      <button
        type="button"
        className="mi"
        role={item.checked === undefined ? "menuitem" : "menuitemradio"}
        aria-checked={item.checked}
        disabled={item.disabled}
        tabIndex={-1}
        onClick={() => {
          onClose();
          item.onSelect();
        }}
      >
        {icon ? <Icon name={icon} small /> : <span className="noicon" />}
        <MenuLabel {...item} />
        {item.hint && <span className="k">{item.hint}</span>}
      </button>
    </>
  );
}

function MenuLabel({ label, end }: MenuItem) {
  if (!end || !label.endsWith(end)) return <span className="cut">{label}</span>;
  return (
    <span className="endkept" title={label}>
      <span className="cut">{label.slice(0, -end.length)}</span>
      <span className="cut">{end}</span>
    </span>
  );
}

/** Where one of all is chosen, the keys begin there. */
function chosen(menu: HTMLElement): HTMLElement | undefined {
  const all = enabled(menu);
  if (all.some((item) => !item.hasAttribute("aria-checked"))) return;
  return all.find((item) => item.getAttribute("aria-checked") === "true");
}

function enabled(menu: HTMLElement): HTMLElement[] {
  return [...menu.querySelectorAll<HTMLElement>("button:not([disabled])")];
}

interface MenuButtonProps {
  /** The accessible name of the button and of its menu. */
  label: string;
  /** The tooltip if it is not the name, for example why the button is disabled. */
  title?: string;
  className?: string;
  /** Asked for at each drawing: it only says what there is. */
  items: () => readonly MenuItem[];
  /** What opening it begins, for example to ask the server for what the items show. */
  onOpen?: () => void;
  disabled?: boolean;
  children: ReactNode;
}

/** A button that opens a menu below itself. */
export function MenuButton({
  label,
  title = label,
  className = "btn quiet sm",
  items,
  onOpen,
  disabled,
  children,
}: MenuButtonProps) {
  const [at, setAt] = useState<MenuProps["at"] | null>(null);
  return (
    <>
      <button
        type="button"
        className={className}
        aria-label={label}
        title={title}
        aria-haspopup="menu"
        aria-expanded={at !== null}
        disabled={disabled}
        onClick={(event) => {
          if (!at) onOpen?.();
          const { left, bottom, width } = event.currentTarget.getBoundingClientRect();
          setAt(at ? null : { x: left, y: bottom + 4, minWidth: width });
        }}
      >
        {children}
      </button>
      {at && <Menu label={label} items={items()} at={at} onClose={() => setAt(null)} />}
    </>
  );
}
