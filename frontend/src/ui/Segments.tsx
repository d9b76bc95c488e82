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
  onChoose: (value: T) => void;
}

/** A choice between a few words; the arrow keys move along them. */
export function Segments<T extends string>(props: Props<T>) {
  const { label, value, options, disabled = null, look = "sm", onChoose } = props;
  function onKeyDown(event: KeyboardEvent<HTMLDivElement>): void {
    const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
    if (step === undefined) return;
    event.preventDefault();
    const radios = [...event.currentTarget.querySelectorAll<HTMLElement>("[role=radio]")];
    const now = radios.indexOf(document.activeElement as HTMLElement);
    radios[(now + step + radios.length) % radios.length]?.focus();
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
