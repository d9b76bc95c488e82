import type { KeyboardEvent } from "react";
import { Icon, type IconName } from "../../ui/Icon";

interface Props<T extends string> {
  label: string;
  value: T;
  options: readonly { value: T; word: string; title?: string; icon?: IconName }[];
  disabled?: string | null;
  onChoose: (value: T) => void;
}

/** One of a few words; the arrow keys lead along them. */
export function Segments<T extends string>({ label, value, options, disabled = null, onChoose }: Props<T>) {
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
      className={`seg sm${disabled === null ? "" : " lock"}`}
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
          tabIndex={each === value ? 0 : -1}
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
