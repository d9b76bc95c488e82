import { type KeyboardEvent, useCallback, useEffect, useRef, useState } from "react";
import type { Naming } from "../../../../logic/graphic/edit";
import type { Spot } from "../../../../logic/graphic/sheet";
import { entering } from "../../../../store/project/entering";
import { t } from "../../../../text";
import { ComboBox } from "../../../../ui/ComboBox";
import { Icon } from "../../../../ui/Icon";
import { type Offer, useOffers } from "../../../../ui/useOffers";

interface Props {
  naming: Naming;
  /** Where it is drawn. */
  spot: Pick<Spot, "x" | "y" | "width"> & { up?: number };
  label: string;
  /** What is typed cannot be taken: somebody else changed the element meanwhile. */
  lost?: boolean;
  /** What can be offered. */
  names: () => Promise<readonly Offer[]>;
  /** Whether the text was taken. */
  onTake: (text: string, onwards: boolean) => Promise<boolean>;
  onLeave: () => void;
}

const WORD = /[#\p{L}_][\p{L}\p{N}_.]*$/u;
const MOST = 60;
/** What is before the name of a contact or coil: it is closed, of an edge, set or reset. */
const MODE = /^(?:\/|[SRPN] )?/;

/** The name of an element, or the text of a box, where it is drawn. Enter takes it, Tab goes on to the next one, Escape leaves. */
export function NameField({ naming, spot: { x, y, up = 10, width }, label, lost, names, onTake, onLeave }: Props) {
  /** Others may change the element meanwhile. */
  const [opened] = useState(naming.value);
  const [text, setText] = useState(opened);
  const [refused, setBad] = useState(false);
  const bad = lost || refused;
  const [waiting, setWaiting] = useState(false);
  /** The same at once: what is taken moves the focus before the field is drawn again. */
  const taken = useRef(false);
  const input = useRef<HTMLInputElement>(null);
  const all = useRef<Promise<readonly Offer[]>>(undefined);
  const offered = useCallback(async (typed: string): Promise<readonly Offer[]> => {
    const word = (WORD.exec(typed)?.[0] ?? "").toUpperCase();
    if (word === "" || !all.current) return [];
    const found = (await all.current).filter(({ path }) => path.toUpperCase().includes(word));
    const begins = ({ path }: Offer) => path.toUpperCase().startsWith(word);
    return [...found.filter(begins), ...found.filter((each) => !begins(each))];
  }, []);
  const offering = useOffers(offered, MOST);
  const least = naming.offers === "bool" ? 120 : 200;
  const atPin = naming.pin !== undefined;
  const wide = naming.offers === "none" && naming.example ? 360 : atPin ? width : Math.max(least, width);

  // biome-ignore lint/correctness/useExhaustiveDependencies: once, when it opens
  useEffect(() => {
    input.current?.focus();
    const fresh = modeIn(naming.value) === naming.value.length;
    select(naming.value);
    all.current = names();
    // Who has typed nothing yet sees what there is.
    if (fresh && naming.offers !== "none")
      void all.current.then((found) => input.current?.value === naming.value && offering.show(found.slice(0, MOST)));
  }, []);

  const modeIn = (value: string) => (naming.offers === "bool" ? (MODE.exec(value)?.[0].length ?? 0) : 0);

  /** A new name leaves the mode as it is: a closed contact is one by any name. */
  function select(value: string): void {
    input.current?.setSelectionRange(modeIn(value), value.length);
  }

  async function take(wanted: string, onwards: boolean): Promise<void> {
    if (taken.current) return;
    taken.current = true;
    offering.close();
    // What is typed meanwhile would be lost with the field.
    setWaiting(true);
    const taking = onTake(wanted, onwards).catch(() => false);
    entering(taking);
    setBad(!(await taking));
    taken.current = false;
    setWaiting(false);
  }

  /** The text is as it was. */
  function giveUp(): void {
    // The drawing takes the focus: that blur takes nothing.
    taken.current = true;
    entering(Promise.resolve(true));
    onLeave();
  }

  /** What was typed is taken as by Enter; what was refused already is given up. */
  function leave(): void {
    // Not when the whole window loses the focus.
    if (taken.current || document.activeElement === input.current) return;
    if (refused || text === opened) giveUp();
    else void take(text, false);
  }

  function type(typed: string): void {
    if (waiting) return;
    setText(typed);
    setBad(false);
    offering.ask(typed);
  }

  function onKey({ key, ctrlKey, metaKey }: KeyboardEvent): boolean {
    if (key === "Escape") giveUp();
    else if (waiting) return true;
    else if ((ctrlKey || metaKey) && key.toLowerCase() === "a") select(text);
    // A contact or coil of a name that is new: it is declared.
    else if (ctrlKey && key === "Enter" && naming.offers === "bool") void take(`${text} : BOOL`, false);
    else if (key === "Enter" || key === "Tab") void take(text, key === "Tab");
    else return false;
    return true;
  }

  /** A list that nobody asked for is left with its field. */
  function onEscape(event: KeyboardEvent): void {
    if (event.key !== "Escape" || text !== opened) return;
    event.stopPropagation();
    giveUp();
  }

  return (
    // What is typed or clicked here is no key or click of the drawing.
    <span
      className="inplace"
      style={{ left: atPin ? x : Math.max(0, x), top: y - up - 6, width: wide }}
      onKeyDownCapture={onEscape}
      onKeyDown={(event) => event.stopPropagation()}
      onClick={(event) => event.stopPropagation()}
      onDoubleClick={(event) => event.stopPropagation()}
      onPointerDown={(event) => event.stopPropagation()}
    >
      <span className="taking">
        <ComboBox
          input={input}
          className={`inp sm mono${bad ? " bad" : ""}`}
          label={label}
          value={text}
          offering={offering}
          bad={bad}
          placeholder={naming.example}
          onType={type}
          onTake={({ path }, by) => void take(text.replace(WORD, "") + path, by === "Tab")}
          onKey={onKey}
          onBlur={leave}
        />
        <button
          type="button"
          className="btn quiet sm"
          tabIndex={-1}
          title={t("graphic.field.take")}
          aria-label={t("graphic.field.take")}
          // The field is left when it loses the focus.
          onPointerDown={(event) => event.preventDefault()}
          onClick={() => void take(text, false)}
        >
          <Icon name="check" small />
        </button>
      </span>
      {bad && (
        <span className="hint bad" role="alert">
          {t(
            lost
              ? "graphic.field.lost"
              : `graphic.field.bad.${naming.offers === "box" || naming.offers === "step" ? naming.offers : "other"}`,
          )}
        </span>
      )}
    </span>
  );
}
