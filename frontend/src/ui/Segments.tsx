import type { KeyboardEvent } from "react";
import { Icon, type IconName } from "./Icon";

interface Props<T extends string> {
  label: string;
  /** Null: nothing is chosen yet. */
  value: T | null;
  options: readonly { value: T; word: string; title?: string; icon?: IconName }[];
  /** Why nothing can be chosen now. */
  disabled?: string | null;
  /** Additional classes; `sm` by default. */
  look?: string;
  /** A choice acts on the PLC at once: the arrow keys only move the focus, and Space chooses. */
  acts?: boolean;
  onChoose: (value: T) => void;
}

/** A choice between a few words; the arrow keys choose, as they do in a radio group. */
export function Segments<T extends string>(props: Props<T>) {
  const { label, value, options, disabled = null, look = "sm", acts = false, onChoose } = props;
  function onKeyDown(event: KeyboardEvent<HTMLDivElement>): void {
    const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
    if (step === undefined) return;
    event.preventDefault();
    const radios = [...event.currentTarget.querySelectorAll<HTMLElement>("[role=radio]")];
    const now = radios.indexOf(document.activeElement as HTMLElement);
    const next = (now + step + radios.length) % radios.length;
    radios[next]?.focus();
    const chosen = options[next]?.value;
    if (!acts && disabled === null && chosen !== undefined && chosen !== value) onChoose(chosen);
  }
  return (
    <span
      className={`seg ${look}${disabled === null ? "" : " lock"}`}
      role="radiogroup"
      aria-label={label}
      onKeyDown={onKeyDown}
    >
      {options.map(({ value: each, word, title, icon }) => (
        <button
          key={each}
          type="button"
          role="radio"
          className={each === value ? "on" : ""}
          aria-checked={each === value}
          tabIndex={each === (value ?? options[0]?.value) ? 0 : -1}
          title={disabled ?? title}
          disabled={disabled !== null}
          onClick={() => each !== value && onChoose(each)}
        >
          {icon && <Icon name={icon} small />}
          {word}
        </button>
      ))}
    </span>
  );
}
