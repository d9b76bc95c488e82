/** Goes to a file, or to a POU, method, type, variable or value of the project, by some letters of its name; after `#` to names alone; after `>` it is commands. */

import { useEffect, useRef, useState } from "react";
import { COMMANDS, SYMBOLS, showPalette, usePalette } from "../../../store/page/palette";
import { t } from "../../../text";
import { ComboBox } from "../../../ui/ComboBox";
import { useOffers } from "../../../ui/useOffers";
import "./palette.css";
import { type Target, targets } from "./targets";

export function Palette() {
  const begins = usePalette((palette) => palette.begins);
  return begins === null ? null : <Open key={begins} begins={begins} />;
}

function Open({ begins }: { begins: string }) {
  const dialog = useRef<HTMLDialogElement>(null);
  const input = useRef<HTMLInputElement>(null);
  const unasked = usePalette((palette) => palette.unasked);
  const [text, setText] = useState(begins);
  const offering = useOffers(targets, undefined, true);
  const { ask, offers, of } = offering;
  const [entered, setEntered] = useState(false);
  const fresh = of === text.trim();
  useEffect(() => {
    dialog.current?.showModal();
    input.current?.focus();
    ask(begins);
  }, [begins, ask]);

  /** Gives the focus back to where it was, which a command may be about. */
  function close(): void {
    dialog.current?.close();
    showPalette(null);
  }

  function take({ go }: Target): void {
    close();
    go();
  }

  // Enter takes what is offered for this text, not what was offered for an earlier one.
  // biome-ignore lint/correctness/useExhaustiveDependencies: `take` is a new function each time
  useEffect(() => {
    if (!entered || !fresh) return;
    setEntered(false);
    if (offers[0]) take(offers[0]);
  }, [entered, fresh, offers]);

  function type(typed: string): void {
    setText(typed);
    setEntered(false);
    ask(typed);
  }

  const commands = text.startsWith(COMMANDS);
  // Escape closes all of it at once, not the list alone.
  const onKey: typeof offering.onKey = (event, choose) => event.key !== "Escape" && offering.onKey(event, choose);
  const symbols = text.startsWith(SYMBOLS);
  const label = t(commands ? "palette.commands" : symbols ? "goto.symbol" : "goto.label");
  return (
    <dialog
      ref={dialog}
      className={`dialog palette${commands ? " commands" : ""}`}
      aria-label={label}
      onCancel={(event) => {
        event.preventDefault();
        close();
      }}
      onPointerDown={({ target }) => target === dialog.current && close()}
    >
      <ComboBox
        label={label}
        listed={label}
        placeholder={t("goto.placeholder")}
        input={input}
        className="inp"
        value={text}
        offering={{ ...offering, onKey }}
        onType={type}
        onTake={take}
        onKey={({ key }) => {
          if (key === "Escape") close();
          else if (key === "Enter") setEntered(true);
          else return false;
          return true;
        }}
        list="menu"
        pointed
      />
      {unasked && !commands && text !== "" && (
        <p role="status">{t(symbols ? "palette.unasked.symbols" : "palette.unasked")}</p>
      )}
      {offering.nothing && !(unasked && !commands) && text !== "" && (
        <p role="status">{t(commands ? "palette.none" : "goto.none", { text: text.replace(/^[>#]/, "") })}</p>
      )}
    </dialog>
  );
}
